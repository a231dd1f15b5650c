#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "compensation/values/units.h"
#include "drivers/clock.h"
#include "schema/store.h"

namespace gyrocal::faults {

/// A promise of the daemon was broken.
struct Broken {
  std::string what;
};

/// Counts what is asked, and stops at the first answer that is no.
class Checks {
 public:
  void require(bool holds, const char* promise, const std::string& details = {}) {
    ++count_;
    if (!holds) throw Broken{details.empty() ? promise : std::string(promise) + ": " + details};
  }
  [[nodiscard]] std::uint64_t count() const { return count_; }

 private:
  std::uint64_t count_ = 0;
};

/// Events as they are told: one when an outage begins and one when it ends, and never silence.
class JournalCheck {
 public:
  explicit JournalCheck(Checks& checks) : checks_(checks) {}
  /// Another process tells from now on.
  void process_began(Instant world_now);
  void told(const EventInsert& event, Instant world_now);

 private:
  Checks& checks_;
  Instant last_{};
  bool chamber_lost_ = false;
  std::set<std::string> boards_lost_;
};

/// Accepted dwells, by board and setpoint: once stored they stay as they are.
class AcknowledgedCheck {
 public:
  explicit AcknowledgedCheck(Checks& checks) : checks_(checks) {}
  void look(const Store& store);
  [[nodiscard]] std::size_t dwells() const { return seen_.size(); }

 private:
  Checks& checks_;
  std::map<std::pair<BoardId, int>, DwellId> seen_;
};

/// The air as it truly was at a time, while a dwell was logged.
struct TrueAir {
  Duration t;
  Celsius air;
};

/// What must hold of a database whatever happened. `state` is what its campaign must say.
void check_database(const std::string& path, const std::string& state, Kelvin dwell_band,
                    const std::vector<TrueAir>& while_logging, Checks& checks);

}  // namespace gyrocal::faults
