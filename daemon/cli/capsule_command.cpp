#include <fmt/core.h>

#include <charconv>
#include <memory>
#include <nlohmann/json.hpp>

#include "daemon/cli/command.h"
#include "daemon/cli/outcome.h"
#include "daemon/replay/capsule.h"
#include "daemon/replay/replay.h"
#include "gyrocal_version.h"

namespace gyrocal::cli {
namespace {

struct CapsuleOptions {
  replay::CapsuleRequest request;
  std::string from;
  std::string to;
  bool as_json = false;
};

/// "5400" or "1:30:00": campaign time as the progress line shows it.
std::optional<Duration> campaign_time(const std::string& text) {
  double total_s = 0;
  const char* at = text.data();
  const char* const end = at + text.size();
  for (int part = 0; part < 3; ++part) {
    double value = 0;
    const auto read = std::from_chars(at, end, value);
    if (read.ec != std::errc{} || !(value >= 0 && value < 1e8)) return std::nullopt;
    total_s = total_s * 60 + value;
    if (read.ptr == end) return seconds(total_s);
    if (*read.ptr != ':') return std::nullopt;
    at = read.ptr + 1;
  }
  return std::nullopt;
}

Result<void> read_window(CapsuleOptions& options) {
  for (auto [text, into] : {std::pair{&options.from, &options.request.from},
                            std::pair{&options.to, &options.request.to}}) {
    if (text->empty()) continue;
    const auto time = campaign_time(*text);
    if (!time) {
      return fail(Errc::bad_input, fmt::format("\"{}\" is no campaign time", *text),
                  "seconds, or hours:minutes:seconds as the progress line shows: 1:30:00");
    }
    *into = *time;
  }
  if (options.request.from <= options.request.to) return {};
  return fail(Errc::bad_input,
              fmt::format("--from {} is later than --to {}", options.from, options.to));
}

int run(CapsuleOptions options) {
  if (const auto window = read_window(options); !window) return report(window.error());
  options.request.software_version = GYROCAL_VERSION;
  const auto capsule = replay::cut_capsule(options.request);
  if (!capsule) return report(capsule.error());
  const auto replayed = replay::replay({options.request.out});
  if (!replayed) return report(replayed.error());
  if (options.as_json) {
    const nlohmann::ordered_json json{{"format", "gyrocal-capsule/1"},
                                      {"capsule", options.request.out},
                                      {"bytes", capsule->bytes},
                                      {"runs", capsule->runs},
                                      {"from_s", to_seconds(capsule->from)},
                                      {"to_s", to_seconds(capsule->to)},
                                      {"replays_alike", replayed->passed()}};
    fmt::print("{}\n", json.dump(2));
    return exit_done;
  }
  fmt::print("{}: {}; {} bytes\n{}", options.request.out, capsule->note, capsule->bytes,
             replay::report_text(*replayed));
  return exit_done;
}

}  // namespace

void add_capsule(Command& root, Chosen& chosen) {
  auto* command = root.add_subcommand(
      "capsule",
      "Examples: gyrocal capsule weekend.db --out weekend.capsule\n"
      "          gyrocal capsule weekend.db --from 9:40:00 --to 10:05:00 --out odd.capsule\n"
      "Cuts one file out of a recorded campaign, for a bug report: bytes, database, campaign "
      "file,\n"
      "chamber profile, version. `gyrocal replay odd.capsule` needs nothing else; this command\n"
      "replays it once and says how that went. A run replays from its beginning, so the file\n"
      "holds the bytes from the beginning of the run that --from lies in up to --to; what earlier\n"
      "runs stored is in its database. Without a window: the whole campaign, models included.");
  const auto options = std::make_shared<CapsuleOptions>();
  command->add_option("database", options->request.database, "the campaign's database")->required();
  command->add_option("--recording", options->request.recording,
                      "default: NAME.recording.db beside the database");
  command->add_option("--campaign", options->request.campaign,
                      "number of the campaign; default: the latest");
  command->add_option("--from", options->from, "campaign time, s or h:mm:ss; default: the start");
  command->add_option("--to", options->to, "campaign time, s or h:mm:ss; default: the end");
  command->add_option("--out,-o", options->request.out, "the file to make")->required();
  command->add_flag("--json", options->as_json, "print JSON");
  command->callback([options, &chosen] { chosen = [options] { return run(*options); }; });
}

}  // namespace gyrocal::cli
