#include "tests/bench/virtual_campaign.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <fstream>
#include <map>

#include "config/text_file.h"
#include "drivers/board/parser.h"
#include "drivers/recording/recording_file.h"
#include "schema/sqlite.h"
#include "tests/bench/measure.h"

namespace gyrocal::bench {
namespace {

Result<double> number_in(const Database& database, const char* sql) {
  const auto value = database.integer(sql);
  return value ? Result<double>(static_cast<double>(*value)) : tl::unexpected(value.error());
}

bool is_command(const RecordedEvent& event, inemo::Id id) {
  return event.kind == RecordedEvent::Kind::written && event.sent.size() >= inemo::header_bytes &&
         event.sent[2] == static_cast<std::uint8_t>(id);
}

/// One board's side of a recording, as InemoBoard would have it.
class Decoder {
 public:
  void take(const RecordedEvent& event) {
    if (is_command(event, inemo::Id::set_output_mode)) {
      mode_ = inemo::decode_output_mode(std::span(event.sent).subspan(inemo::header_bytes));
    }
    if (is_command(event, inemo::Id::start) && mode_) parser_.expect(*mode_);
    if (event.kind == RecordedEvent::Kind::read) {
      events_.clear();
      parser_.feed(event.received, event.end, events_);
    }
  }
  [[nodiscard]] double frames() const { return static_cast<double>(parser_.tally().frames); }

 private:
  inemo::Parser parser_;
  std::optional<inemo::OutputMode> mode_;
  std::vector<inemo::Event> events_;
};

}  // namespace

Result<void> write_campaign_file(const std::string& path, const Changes& changes) {
  auto text = read_text_file(GYROCAL_SOURCE_DIR "/config/campaigns/demo.toml");
  if (!text) return tl::unexpected(text.error());
  for (const auto& [line, by] : changes) {
    const auto at = text->find(line);
    if (at == std::string::npos) {
      return fail(Errc::bad_input, fmt::format("config/campaigns/demo.toml: no \"{}\"", line));
    }
    text->replace(at, line.size(), by);
  }
  std::ofstream(path) << *text;
  return {};
}

Result<VirtualRun> run_virtual(const std::string& file, const std::string& database, bool record) {
  const std::vector<std::string> command{
      GYROCAL_PROGRAM, "run",    file,
      "--virtual",     "--seed", "7",
      "--db",          database, record ? "--record" : "--no-record"};
  auto process = run_child(command);
  if (!process || process->exit_code != 0) {
    return fail(Errc::refused, fmt::format("{} failed", fmt::join(command, " ")));
  }
  const auto opened = Database::open(database, OpenMode::read_only);
  if (!opened) return tl::unexpected(opened.error());
  const auto end_ns = number_in(*opened, "SELECT max(t_ns) FROM event");
  const auto frames = number_in(*opened, "SELECT sum(frames) FROM monitor");
  const auto samples = number_in(*opened, "SELECT sum(samples) FROM dwell");
  if (!end_ns || !frames || !samples) {
    return fail(Errc::mismatch, database + ": holds no campaign");
  }
  return VirtualRun{std::move(*process), *end_ns * 1e-9, *frames, *samples};
}

Result<Decoded> decode_recording(const std::string& recording) {
  const double before = cpu_now_s();
  auto reader = RecordingReader::open(recording, 1);
  if (!reader) return tl::unexpected(reader.error());
  std::map<std::uint32_t, Decoder> boards;  // by stream; the chamber's has no reads
  for (;;) {
    const auto event = reader->next();
    if (!event) return tl::unexpected(event.error());
    if (!*event) break;
    boards[(*event)->stream].take(**event);
  }
  Decoded decoded;
  for (const auto& [stream, decoder] : boards) decoded.frames += decoder.frames();
  decoded.cpu_s = cpu_now_s() - before;
  return decoded;
}

}  // namespace gyrocal::bench
