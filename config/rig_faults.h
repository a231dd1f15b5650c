#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "compensation/values/error.h"

namespace gyrocal {

/// What can go wrong with a simulated device. `value` means what stands in brackets.
enum class RigFaultKind {
  // the chamber's wire
  refuse,          ///< connections are closed and refused
  late,            ///< replies come late [by s, real time on real endpoints]
  lost,            ///< requests are carried out, replies are lost
  half,            ///< the first half of a reply comes
  doubled,         ///< each reply comes twice
  exception,       ///< nothing is carried out [exception code]
  wrong_unit,      ///< replies bear the next unit's number
  wrong_register,  ///< reads are answered with another register, writes name another
  // the chamber itself
  wrong_value,     ///< the thermometer is off [K]
  spurious_zero,   ///< the thermometer reads 0.0
  stuck,           ///< the thermometer stands still
  dead,            ///< no mains: silence, and a chamber that is stopped afterwards
  panel_setpoint,  ///< somebody sets the setpoint at the panel [degC]
  panel_stop,      ///< somebody stops the chamber at the panel
  // a board
  unplug,              ///< and plugged in again at the end
  mute,                ///< hangs: takes nothing, sends nothing
  garbage,             ///< bytes inserted between frames and cut out of them [share of frames]
  duplicate,           ///< frames come twice [share of frames]
  drop,                ///< frames are counted and lost [share of frames]
  reset,               ///< boots without a word: a brown-out
  freeze_temperature,  ///< the STLM75 stands still while it is read at 10 Hz or faster
};

struct RigFault {
  RigFaultKind kind = RigFaultKind::lost;
  double at_s = 0;                   ///< campaign time; a frame due then is not hit yet
  double for_s = 0;                  ///< 0 for what happens at an instant
  std::optional<std::size_t> board;  ///< index; absent: the chamber
  double value = 0;
  bool operator==(const RigFault&) const = default;
};

/// Reads a list of faults:
///
///   [[fault]]
///   at_s = 3600
///   for_s = 30            # not for panel_setpoint, panel_stop, reset
///   device = "chamber"    # or a board's name
///   kind = "late"
///   value = 2.5           # only where the kind has one; late 2, exception 6, wrong_value 5,
///                         # shares 0.05; panel_setpoint must say it
///
/// @param board_names  in the order of their indices.
/// @return bad_input, unknown_name, out_of_range, not_finite or storage; `what` names file, line,
///   key, what stands there and what was expected.
[[nodiscard]] Result<std::vector<RigFault>> read_rig_faults(
    const std::string& path, const std::vector<std::string>& board_names);

/// Same, from text; `path` only names it in messages.
[[nodiscard]] Result<std::vector<RigFault>> parse_rig_faults(
    const std::string& text, const std::string& path, const std::vector<std::string>& board_names);

}  // namespace gyrocal
