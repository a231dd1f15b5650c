#include <fmt/core.h>

#include <memory>

#include "daemon/cli/command.h"
#include "daemon/cli/outcome.h"
#include "daemon/cli/text_output.h"
#include "daemon/replay/replay.h"
#include "gyrocal_version.h"

namespace gyrocal::cli {
namespace {

struct ReplayOptions {
  std::string recording;
  std::string against;
  std::string campaign;
  std::string junit;
  bool as_json = false;
};

int run(const ReplayOptions& options) {
  replay::ReplayRequest request;
  request.recording = options.recording;
  if (!options.against.empty()) request.against = options.against;
  if (!options.campaign.empty()) request.campaign = options.campaign;
  const auto replayed = replay::replay(request);
  if (!replayed) return report(replayed.error());
  fmt::print("{}", options.as_json ? replay::report_json(*replayed, GYROCAL_VERSION) + "\n"
                                   : replay::report_text(*replayed));
  if (!options.junit.empty()) {
    const auto written = write_text_file(options.junit, replay::report_junit(*replayed));
    if (!written) return report(written.error());
  }
  return replayed->passed() ? exit_done : exit_differs;
}

}  // namespace

void add_replay(Command& root, Chosen& chosen) {
  auto* command = root.add_subcommand(
      "replay",
      "Examples: gyrocal replay weekend.recording.db\n"
      "          gyrocal replay weekend.recording.db --campaign stricter.toml\n"
      "Runs what a campaign recorded through today's codecs, decisions, store and analysis, "
      "without\n"
      "devices and without waiting, twice, and compares with the campaign's database: what was\n"
      "written to the devices, every decision, sample and model. A recording that a crash cut off\n"
      "is replayed up to its end. Exit: 0 the same, 4 it differs, with the first difference.");
  const auto options = std::make_shared<ReplayOptions>();
  command->add_option("recording", options->recording, "NAME.recording.db, or a capsule")
      ->required();
  command->add_option("--against", options->against,
                      "the campaign's database; default: the capsule's own, else NAME.db beside");
  command->add_option("--campaign", options->campaign,
                      "decide by this campaign file instead: what would it have changed?");
  command->add_option("--junit", options->junit, "write the outcome as JUnit XML too");
  command->add_flag("--json", options->as_json, "print JSON");
  command->callback([options, &chosen] { chosen = [options] { return run(*options); }; });
}

}  // namespace gyrocal::cli
