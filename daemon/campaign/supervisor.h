#pragma once

#include <optional>
#include <string>

#include "daemon/campaign/plan.h"
#include "drivers/chamber/chamber.h"

namespace gyrocal::campaign {

/// Why the campaign must stop at once.
struct Trip {
  std::string why;
  bool hands_off = false;  ///< somebody else commands the chamber: nothing more is written to it
};

/// Looks at every reading of the chamber, outside the list of steps: the campaign's own reasoning
/// may be wrong, and this does not share it. Pure; stale readings are the caller's to notice, and
/// doubtful ones must not come here (ReadingFilter).
///
///   what                                            trips after
///   air beyond boards ∩ chamber by 5 K              at once
///   setpoint, run state or mode not ours            2 readings in a row
///   air off its way by 5 K (wrong way, past the     10 min: an opened door is shorter, and costs
///     target, or fallen back)                         a dwell only
///   reading the same to the last bit while the      10 min
///     setpoint is 3 K away
class Supervisor {
 public:
  explicit Supervisor(const SetpointRange& allowed) : allowed_(allowed) {}

  /// The chamber is sent from where it is to `target`, by way of setpoints in between.
  void sent_to(Celsius target);
  /// @param commanded  the setpoint last written and confirmed, if any.
  [[nodiscard]] std::optional<Trip> look(Duration t, const ChamberReading& reading,
                                         std::optional<Celsius> commanded);

 private:
  [[nodiscard]] std::optional<Trip> beyond_limits(Celsius air) const;
  [[nodiscard]] std::optional<Trip> foreign_hand(const ChamberReading& reading,
                                                 std::optional<Celsius> commanded);
  [[nodiscard]] std::optional<Trip> off_its_way(Duration t, Celsius air);
  [[nodiscard]] std::optional<Trip> stuck(Duration t, const ChamberReading& reading);

  SetpointRange allowed_;
  std::optional<Celsius> air_;
  std::optional<Celsius> from_;
  std::optional<Celsius> target_;
  int foreign_readings_ = 0;
  std::optional<Duration> off_since_;
  std::optional<Duration> same_since_;
};

}  // namespace gyrocal::campaign
