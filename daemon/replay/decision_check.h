#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "drivers/recording/replay_layers.h"
#include "schema/store.h"

namespace gyrocal::replay {

/// The first thing a replay does otherwise than the recorded campaign.
struct Difference {
  std::int64_t run = 0;  ///< number of the run in the recording
  Duration t{};          ///< campaign time
  std::string what;      ///< "decision", "command", "sample", "model" ...
  std::string expected;  ///< what was recorded
  std::string got;
  std::string sentence;  ///< for a person
  bool operator==(const Difference&) const = default;
};

/// A resumed run begins at least ten seconds after the latest row it finds. What is stored up to
/// here after a run's end is that run's: a board's clock may run ahead of ours.
inline constexpr Duration end_slack = std::chrono::seconds{5};

/// Holds what a replay writes into its journal against what the recorded campaign wrote, as it
/// comes: a decision shows there before it shows in what passes the links.
class DecisionCheck {
 public:
  explicit DecisionCheck(const Tape& tape) : tape_(tape) {}

  /// Campaign time 0 is `origin`; `recorded` is what this run wrote, in order.
  void begin(Instant origin, std::vector<EventInsert> recorded);
  void decided(const EventInsert& event);
  /// What was decided last could not be stored then: the journal does not have it.
  void not_stored() { more_.reset(); }
  /// A decision differs, or what passed the links.
  [[nodiscard]] bool differs() const { return decision_.has_value() || tape_.diverged(); }
  /// After the end of the run, however it came.
  /// @param cut_off  the recording ends before the run did: what either side has more is no
  ///   difference.
  [[nodiscard]] std::optional<Difference> first(bool cut_off) const;

  [[nodiscard]] std::int64_t alike() const { return static_cast<std::int64_t>(alike_); }
  [[nodiscard]] Instant origin() const { return origin_; }

 private:
  [[nodiscard]] const EventInsert* next_recorded() const;
  [[nodiscard]] Difference at_links() const;

  const Tape& tape_;
  Instant origin_{};
  std::vector<EventInsert> recorded_;
  std::size_t alike_ = 0;
  std::optional<Difference> decision_;
  std::optional<EventInsert> more_;  ///< the first decided beyond the last recorded
  std::optional<EventInsert> late_;  ///< the first decided where the tape no longer fitted
};

}  // namespace gyrocal::replay
