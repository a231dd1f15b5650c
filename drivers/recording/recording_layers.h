#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "drivers/clock.h"
#include "drivers/link.h"
#include "drivers/recording/recording_file.h"

namespace gyrocal {

/// What the recording layers of one run share: the clock below them, the file, and the time the
/// program above them sees. That time stands still between two things that come from outside: it
/// changes only when a sleep returns or a link has carried something. So a program on one thread
/// that has its time and its bytes from these layers alone does, on a replay, the same to the last
/// bit. What lies below the layers (the links themselves) takes the clock below.
///
///   const auto writer = RecordingWriter::open("a.recording.db", {.streams = {"chamber"}},
///                                             seconds(time_scale));
///   Recorder recorder(real_clock, **writer);
///   RecordingClock clock(recorder);                            // for the drivers and the daemon
///   ModbusLink wire(address, reply_timeout, real_clock);       // below
///   RecordingRequestLink link(wire, recorder, 1);              // what ModbusChamber gets
///
/// replay_layers.h plays it back.
class Recorder {
 public:
  /// Both must outlive this.
  Recorder(Clock& clock, RecordingWriter& writer);

  [[nodiscard]] Clock& clock_below() { return clock_; }
  [[nodiscard]] Instant now() const { return now_; }
  /// Records `event` as ending at the time of the clock below, to which now() goes on.
  void record(RecordedEvent event);
  /// Records `event` without time passing.
  void record_at_once(RecordedEvent event);
  /// Records that the program, asking for `what`, was told `answer`: a signal, an operator's
  /// command, the room on the disk. Time does not pass.
  void input(std::string_view what, std::string_view answer);
  [[nodiscard]] std::uint64_t events() const { return events_; }  ///< recorded so far

 private:
  Clock& clock_;
  RecordingWriter& writer_;
  Instant now_;
  std::uint64_t events_ = 0;
};

class RecordingClock final : public Clock {
 public:
  explicit RecordingClock(Recorder& recorder) : recorder_(recorder) {}
  [[nodiscard]] Instant now() const override { return recorder_.now(); }
  void sleep_until(Instant when) override;
  [[nodiscard]] std::int64_t utc_ns() const override;

 private:
  Recorder& recorder_;
};

class RecordingRequestLink final : public RequestLink {
 public:
  /// @param stream  1-based place of this link's name in RecordedRun::streams.
  RecordingRequestLink(RequestLink& target, Recorder& recorder, std::uint32_t stream)
      : target_(target), recorder_(recorder), stream_(stream) {}
  [[nodiscard]] Result<Bytes> transact(std::span<const std::uint8_t> request) override;

 private:
  RequestLink& target_;
  Recorder& recorder_;
  std::uint32_t stream_;
};

class RecordingByteLink final : public ByteLink {
 public:
  RecordingByteLink(ByteLink& target, Recorder& recorder, std::uint32_t stream)
      : target_(target), recorder_(recorder), stream_(stream) {}
  [[nodiscard]] Result<std::size_t> read(std::span<std::uint8_t> into) override;
  [[nodiscard]] Result<void> write(std::span<const std::uint8_t> bytes) override;
  [[nodiscard]] Result<void> reopen() override;

 private:
  [[nodiscard]] RecordedEvent begun(RecordedEvent::Kind kind);

  ByteLink& target_;
  Recorder& recorder_;
  std::uint32_t stream_;
  std::uint32_t empty_reads_ = 0;  ///< since the recorder's event number empty_since_
  std::uint64_t empty_since_ = 0;
};

}  // namespace gyrocal
