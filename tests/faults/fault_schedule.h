#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "compensation/rig/rig_model.h"
#include "config/rig_faults.h"
#include "drivers/clock.h"

/// A campaign with everything that will go wrong in it, drawn from one number.
namespace gyrocal::faults {

/// What goes wrong with the daemon's machine, or what a person does to the daemon.
enum class HostFaultKind {
  stopped,      ///< the process stands still, time goes on [for_s]
  slept,        ///< a laptop: the steady clock stands still as well [for_s]
  clock_step,   ///< UTC is set [value: by s]
  disk_little,  ///< 50 MB are left [for_s]
  disk_full,    ///< 10 MB are left [for_s]
  crash,        ///< kill -9, started again later [for_s]; value: after so many more calls
  power_cut,    ///< as crash, and nobody makes the chamber safe meanwhile
  pause,        ///< and resumed [for_s]
  skip,
  abort,
  sigterm,  ///< and started again [for_s]
};

struct HostFault {
  HostFaultKind kind = HostFaultKind::stopped;
  double for_s = 0;
  double value = 0;
};

/// When a fault begins: so long after the campaign is first seen in a state, at a setpoint; or, if
/// `state` is empty, after the world began.
struct Trigger {
  std::string state;
  std::size_t point = 0;
  double after_s = 0;
};

struct PlannedFault {
  Trigger when;
  std::variant<RigFault, HostFault> fault;  ///< at_s of a RigFault does not count
};

struct Schedule {
  std::string campaign;  ///< the campaign file
  rig::RigModel model;   ///< a chamber of 0.5 to 3 times the usual speed
  Duration tick{};       ///< of the daemon's loop
  std::vector<PlannedFault> faults;
};

/// Pure: the same seed gives the same schedule. Up to three faults at once on every link and on the
/// machine, one to three times a campaign; one seed in twenty has none.
[[nodiscard]] Schedule draw_schedule(std::uint64_t seed);

/// One line a fault.
[[nodiscard]] std::string to_text(const Schedule& schedule);

}  // namespace gyrocal::faults
