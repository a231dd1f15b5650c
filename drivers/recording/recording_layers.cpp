#include "drivers/recording/recording_layers.h"

#include <utility>

namespace gyrocal {
namespace {

template <class T>
void note_error(RecordedEvent& event, const Result<T>& result) {
  if (!result) event.error = result.error();
}

}  // namespace

Recorder::Recorder(Clock& clock, RecordingWriter& writer)
    : clock_(clock), writer_(writer), now_(clock.now()) {
  RecordedEvent start;  // tells a replay when this was
  start.begin = now_;
  record_at_once(std::move(start));
}

void Recorder::record(RecordedEvent event) {
  now_ = clock_.now();
  record_at_once(std::move(event));
}

void Recorder::record_at_once(RecordedEvent event) {
  event.end = now_;
  writer_.append(std::move(event));
  ++events_;
}

void Recorder::input(std::string_view what, std::string_view answer) {
  RecordedEvent event;
  event.kind = RecordedEvent::Kind::input;
  event.begin = now_;
  event.sent.assign(what.begin(), what.end());
  event.received.assign(answer.begin(), answer.end());
  record_at_once(std::move(event));
}

void RecordingClock::sleep_until(Instant when) {
  recorder_.clock_below().sleep_until(when);
  RecordedEvent event;
  event.begin = when;
  recorder_.record(std::move(event));
}

std::int64_t RecordingClock::utc_ns() const {
  const std::int64_t utc_ns = recorder_.clock_below().utc_ns();
  RecordedEvent event;
  event.kind = RecordedEvent::Kind::told_utc;
  event.begin = Instant{Duration{utc_ns}};
  recorder_.record_at_once(std::move(event));
  return utc_ns;
}

Result<Bytes> RecordingRequestLink::transact(std::span<const std::uint8_t> request) {
  RecordedEvent event;
  event.kind = RecordedEvent::Kind::transacted;
  event.stream = stream_;
  event.begin = recorder_.clock_below().now();
  auto reply = target_.transact(request);
  event.sent.assign(request.begin(), request.end());
  if (reply) event.received = *reply;
  note_error(event, reply);
  recorder_.record(std::move(event));
  return reply;
}

RecordedEvent RecordingByteLink::begun(RecordedEvent::Kind kind) {
  RecordedEvent event;
  event.kind = kind;
  event.stream = stream_;
  event.begin = recorder_.clock_below().now();
  return event;
}

Result<std::size_t> RecordingByteLink::read(std::span<std::uint8_t> into) {
  RecordedEvent event = begun(RecordedEvent::Kind::read);
  auto count = target_.read(into);
  if (recorder_.events() != empty_since_) empty_reads_ = 0;
  if (count && *count == 0) {
    empty_since_ = recorder_.events();
    ++empty_reads_;
    return count;
  }
  event.empty_reads_before = empty_reads_;
  empty_reads_ = 0;
  if (count) {
    const auto bytes = into.first(*count);
    event.received.assign(bytes.begin(), bytes.end());
  }
  note_error(event, count);
  recorder_.record(std::move(event));
  return count;
}

Result<void> RecordingByteLink::write(std::span<const std::uint8_t> bytes) {
  RecordedEvent event = begun(RecordedEvent::Kind::written);
  auto done = target_.write(bytes);
  event.sent.assign(bytes.begin(), bytes.end());
  note_error(event, done);
  recorder_.record(std::move(event));
  return done;
}

Result<void> RecordingByteLink::reopen() {
  RecordedEvent event = begun(RecordedEvent::Kind::reopened);
  auto done = target_.reopen();
  note_error(event, done);
  recorder_.record(std::move(event));
  return done;
}

}  // namespace gyrocal
