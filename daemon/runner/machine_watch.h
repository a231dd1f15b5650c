#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "drivers/clock.h"

namespace gyrocal::runner {

/// What happened to the machine, as an event; how much it matters is the caller's to act on.
struct MachineNotice {
  std::string severity;
  std::string kind;
  std::string text;
  bool slept = false;      ///< nobody watched the chamber for a while
  bool disk_full = false;  ///< the next group may not be stored
};

/// Watches the machine under the campaign: UTC against the steady clock (a stepped clock, a laptop
/// that slept: the steady clock stands meanwhile) and the room left for the database. Each trouble
/// is told once, until it is over.
class MachineWatch {
 public:
  /// @param utc_rate  seconds of campaign time in one of UTC.
  explicit MachineWatch(double utc_rate) : utc_rate_(utc_rate) {}
  [[nodiscard]] std::vector<MachineNotice> look(Duration t, std::int64_t utc_ns,
                                                std::uintmax_t bytes_free);

 private:
  [[nodiscard]] std::optional<MachineNotice> clocks(Duration t, std::int64_t utc_ns);
  [[nodiscard]] std::optional<MachineNotice> disk(std::uintmax_t bytes_free);

  double utc_rate_;
  std::optional<Duration> last_t_;
  std::int64_t last_utc_ns_ = 0;
  bool little_told_ = false;
  bool full_told_ = false;
};

}  // namespace gyrocal::runner
