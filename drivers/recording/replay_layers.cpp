#include "drivers/recording/replay_layers.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <utility>

namespace gyrocal {
namespace {

using Kind = RecordedEvent::Kind;

RecordedEvent call(Kind kind, std::uint32_t stream, std::span<const std::uint8_t> sent = {}) {
  RecordedEvent event;
  event.kind = kind;
  event.stream = stream;
  event.sent.assign(sent.begin(), sent.end());
  return event;
}

bool is_answered_by(const RecordedEvent& call, const RecordedEvent& event) {
  if (call.kind != event.kind || call.stream != event.stream || call.sent != event.sent) {
    return false;
  }
  return call.kind != Kind::woke || call.begin == event.begin;
}

}  // namespace

Tape::Tape(RecordingReader reader, RecordedRun run)
    : reader_(std::move(reader)), run_(std::move(run)) {
  advance();
  if (!next_) return;
  now_ = reached_ = next_->end;  // the first event only tells when the recording began
  advance();
}

void Tape::advance() {
  auto next = reader_.next();
  if (!next) trouble_ = next.error();
  next_ = next ? std::move(*next) : std::nullopt;
}

void Tape::count(const RecordedEvent& event) {
  counts_.requests += event.kind == Kind::transacted ? 1 : 0;
  counts_.writes += event.kind == Kind::written ? 1 : 0;
  counts_.bytes_read += event.kind == Kind::read ? event.received.size() : 0;
}

Result<RecordedEvent> Tape::answer(const RecordedEvent& call) {
  if (!diverged_ && next_) {
    if (is_answered_by(call, *next_)) {
      RecordedEvent event = std::move(*next_);
      now_ = reached_ = event.end;
      count(event);
      advance();
      return event;
    }
    diverged_ = Divergence{now_, describe(*next_), describe(call)};
  }
  if (!diverged_) return fail(Errc::link_lost, "the recording ends here");
  return fail(Errc::mismatch,
              fmt::format("recorded: {}; now: {}", diverged_->recorded, diverged_->replayed));
}

std::optional<std::string> Tape::input_if(std::string_view what) {
  const RecordedEvent* const next = next_if(Kind::input, 0);
  if (next == nullptr ||
      !std::equal(what.begin(), what.end(), next->sent.begin(), next->sent.end()))
    return std::nullopt;
  return *input(what);
}

Result<std::string> Tape::input(std::string_view what) {
  RecordedEvent asked;
  asked.kind = Kind::input;
  asked.sent.assign(what.begin(), what.end());
  const auto told = answer(asked);
  if (!told) return tl::unexpected(told.error());
  return std::string(told->received.begin(), told->received.end());
}

const RecordedEvent* Tape::next_if(Kind kind, std::uint32_t stream) const {
  const bool fits = !diverged_ && next_ && next_->kind == kind && next_->stream == stream;
  return fits ? &*next_ : nullptr;
}

void ReplayClock::sleep_until(Instant when) {
  RecordedEvent event = call(Kind::woke, 0);
  event.begin = when;
  if (!tape_.answer(event)) tape_.pass_to(when);
}

std::int64_t ReplayClock::utc_ns() const {
  const auto told = tape_.answer(call(Kind::told_utc, 0));
  return told ? told->begin.time_since_epoch().count() : 0;
}

std::string Tape::describe(const RecordedEvent& event) const {
  const std::string link = event.stream >= 1 && event.stream <= run_.streams.size()
                               ? run_.streams[event.stream - 1]
                               : fmt::format("link {}", event.stream);
  switch (event.kind) {
    case Kind::woke:
      return fmt::format("sleep until {:.3f} s", to_seconds(event.begin - origin_));
    case Kind::told_utc:
      return asking_utc;
    case Kind::read:
      return fmt::format("read from {}", link);
    case Kind::written:
      return fmt::format("write {:02x} to {}", fmt::join(event.sent, " "), link);
    case Kind::reopened:
      return fmt::format("open {}", link);
    case Kind::transacted:
      return fmt::format("ask {} {:02x}", link, fmt::join(event.sent, " ")) +
             (meaning_ ? " (" + meaning_(event.sent) + ")" : "");
    case Kind::input:
      return std::string(event.sent.begin(), event.sent.end());
  }
  return "something unknown";
}

Result<Bytes> ReplayRequestLink::transact(std::span<const std::uint8_t> request) {
  auto event = tape_.answer(call(Kind::transacted, stream_, request));
  if (!event) return tl::unexpected(event.error());
  if (event->error) return tl::unexpected(*event->error);
  return std::move(event->received);
}

Result<std::size_t> ReplayByteLink::read(std::span<std::uint8_t> into) {
  const RecordedEvent* const next = tape_.next_if(Kind::read, stream_);
  if (next == nullptr) {
    if (!tape_.ended() && !tape_.diverged()) return std::size_t{0};
    return tl::unexpected(tape_.answer(call(Kind::read, stream_)).error());
  }
  if (empty_reads_ < next->empty_reads_before) {
    ++empty_reads_;
    return std::size_t{0};
  }
  empty_reads_ = 0;
  const auto event = tape_.answer(call(Kind::read, stream_));
  if (event->error) return tl::unexpected(*event->error);
  if (event->received.size() > into.size()) {
    return fail(Errc::mismatch, fmt::format("room for {} bytes, {} were recorded", into.size(),
                                            event->received.size()));
  }
  std::copy(event->received.begin(), event->received.end(), into.begin());
  return event->received.size();
}

Result<void> ReplayByteLink::write(std::span<const std::uint8_t> bytes) {
  return repeat(Kind::written, bytes);
}

Result<void> ReplayByteLink::reopen() { return repeat(Kind::reopened, {}); }

Result<void> ReplayByteLink::repeat(Kind kind, std::span<const std::uint8_t> sent) {
  const auto event = tape_.answer(call(kind, stream_, sent));
  if (!event) return tl::unexpected(event.error());
  if (event->error) return tl::unexpected(*event->error);
  return {};
}

}  // namespace gyrocal
