#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "drivers/clock.h"
#include "drivers/link.h"
#include "drivers/recording/recording_file.h"

namespace gyrocal {

/// Where a replayed program first did something else than the recorded one.
struct Divergence {
  Instant at{};          ///< on the run's clock
  std::string recorded;  ///< "write 20 01 53 to board left"
  std::string replayed;
  bool operator==(const Divergence&) const = default;
};

/// How much of a recorded run has been repeated.
struct TapeCounts {
  std::uint64_t requests = 0;  ///< to request links, as recorded to the byte
  std::uint64_t writes = 0;    ///< to byte links
  std::uint64_t bytes_read = 0;
  bool operator==(const TapeCounts&) const = default;
};

/// The events of a recorded run, handed out in their order, with the time they took place. Notices
/// the first call that is not the recorded one. From then on, and after the end of the recording,
/// links answer with errors and sleeping just lets time pass: whoever replays looks at diverged()
/// and ended() and stops.
class Tape {
 public:
  /// @param run  the one of which `reader` reads the events.
  Tape(RecordingReader reader, RecordedRun run);

  [[nodiscard]] Instant now() const { return now_; }
  /// The time of the latest thing that was as recorded; now() goes on after the end.
  [[nodiscard]] Instant reached() const { return reached_; }
  static constexpr const char* asking_utc = "ask for UTC";  ///< in a Divergence
  /// Times in descriptions count from here; else from the clock's own zero.
  void count_from(Instant origin) { origin_ = origin; }
  /// What requests mean, for descriptions: beside their bytes.
  void explain_requests(std::function<std::string(std::span<const std::uint8_t>)> meaning) {
    meaning_ = std::move(meaning);
  }
  void pass_to(Instant when) { now_ = std::max(now_, when); }
  [[nodiscard]] const std::optional<Divergence>& diverged() const { return diverged_; }
  /// There is no more: the recording was cut off here, or the program does more than it did.
  [[nodiscard]] bool ended() const { return !next_; }
  /// Nothing of the recorded run is left that a program could still repeat.
  [[nodiscard]] bool over() const { return ended() || diverged().has_value(); }
  [[nodiscard]] const TapeCounts& counts() const { return counts_; }
  /// Why the file could not be read to its end.
  [[nodiscard]] const std::optional<Error>& trouble() const { return trouble_; }

  /// What `call` got in the recorded run: the next event, if kind, link and bytes sent are the
  /// same.
  /// @return link_lost after the end, mismatch after a divergence.
  [[nodiscard]] Result<RecordedEvent> answer(const RecordedEvent& call);
  /// What the program was told when it asked for `what` here, if it was.
  [[nodiscard]] std::optional<std::string> input_if(std::string_view what);
  /// Same, of one that asks for certain where it did in the recorded run.
  [[nodiscard]] Result<std::string> input(std::string_view what);
  /// The next event, if it is one of this kind and link.
  [[nodiscard]] const RecordedEvent* next_if(RecordedEvent::Kind kind, std::uint32_t stream) const;

 private:
  void advance();
  void count(const RecordedEvent& event);
  [[nodiscard]] std::string describe(const RecordedEvent& event) const;

  RecordingReader reader_;
  RecordedRun run_;
  std::optional<RecordedEvent> next_;
  Instant now_{};
  std::function<std::string(std::span<const std::uint8_t>)> meaning_;
  Instant reached_{};
  Instant origin_{};
  TapeCounts counts_;
  std::optional<Divergence> diverged_;
  std::optional<Error> trouble_;
};

/// Time as it was recorded: goes from event to event, without waiting.
class ReplayClock final : public Clock {
 public:
  explicit ReplayClock(Tape& tape) : tape_(tape) {}
  [[nodiscard]] Instant now() const override { return tape_.now(); }
  void sleep_until(Instant when) override;
  /// 0 once the recording does not tell.
  [[nodiscard]] std::int64_t utc_ns() const override;

 private:
  Tape& tape_;
};

class ReplayRequestLink final : public RequestLink {
 public:
  ReplayRequestLink(Tape& tape, std::uint32_t stream) : tape_(tape), stream_(stream) {}
  [[nodiscard]] Result<Bytes> transact(std::span<const std::uint8_t> request) override;

 private:
  Tape& tape_;
  std::uint32_t stream_;
};

class ReplayByteLink final : public ByteLink {
 public:
  ReplayByteLink(Tape& tape, std::uint32_t stream) : tape_(tape), stream_(stream) {}
  [[nodiscard]] Result<std::size_t> read(std::span<std::uint8_t> into) override;
  [[nodiscard]] Result<void> write(std::span<const std::uint8_t> bytes) override;
  [[nodiscard]] Result<void> reopen() override;

 private:
  [[nodiscard]] Result<void> repeat(RecordedEvent::Kind kind, std::span<const std::uint8_t> sent);

  Tape& tape_;
  std::uint32_t stream_;
  std::uint32_t empty_reads_ = 0;  ///< given before the next read
};

}  // namespace gyrocal
