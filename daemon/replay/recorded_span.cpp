#include "daemon/replay/recorded_span.h"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <string_view>

#include "daemon/runner/run_recording.h"

namespace gyrocal::replay {
namespace {

bool is_begin(const RecordedEvent& event) {
  constexpr std::string_view begin = runner::input::begun;
  return event.kind == RecordedEvent::Kind::input &&
         std::equal(begin.begin(), begin.end(), event.sent.begin(), event.sent.end());
}

/// Nothing for a run whose preflight did not pass.
Result<std::optional<RecordedSpan>> span_of(const std::string& recording, const RecordedRun& run) {
  auto reader = RecordingReader::open(recording, run.id);
  if (!reader) return tl::unexpected(reader.error());
  for (;;) {
    const auto event = reader->next();
    if (!event) return tl::unexpected(event.error());
    if (!*event) return std::nullopt;
    if (!is_begin(**event)) continue;
    const auto begun = begun_from({(*event)->received.begin(), (*event)->received.end()});
    if (!begun) return tl::unexpected(begun.error());
    const auto last = reader->last();
    if (!last) return tl::unexpected(last.error());
    const Instant origin = (*event)->end - begun->t;
    return std::optional(
        RecordedSpan{run, CampaignId{begun->campaign}, origin, begun->t, *last - origin});
  }
}

}  // namespace

Result<Begun> begun_from(const std::string& text) {
  Begun begun;
  Duration::rep t_ns = 0;
  const char* const end = text.data() + text.size();
  const auto number = std::from_chars(text.data(), end, begun.campaign);
  const bool separated = number.ec == std::errc{} && number.ptr != end && *number.ptr == ' ';
  if (!separated || std::from_chars(number.ptr + 1, end, t_ns).ec != std::errc{}) {
    return fail(Errc::bad_frame, fmt::format("the recording says a run began at \"{}\"", text),
                "the file is damaged, or of a newer version");
  }
  begun.t = Duration{t_ns};
  return begun;
}

Result<std::vector<RecordedSpan>> recorded_spans(const std::string& recording) {
  const auto runs = recorded_runs(recording);
  if (!runs) return tl::unexpected(runs.error());
  std::vector<RecordedSpan> spans;
  for (const RecordedRun& run : *runs) {
    auto span = span_of(recording, run);
    if (!span) return tl::unexpected(span.error());
    if (*span) spans.push_back(std::move(**span));
  }
  return spans;
}

}  // namespace gyrocal::replay
