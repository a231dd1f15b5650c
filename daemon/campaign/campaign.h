#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "daemon/campaign/plan.h"

namespace gyrocal::campaign {

/// The decisions of a campaign: no clock, no I/O, no log. What the world did arrives as an event,
/// what is to be done leaves as actions; both are journalled, so that a replay is a fold.

/// Which setpoint, and which try at it.
struct Visit {
  std::size_t point = 0;
  int attempt = 1;    ///< 1-based; numbers the dwells
  int disturbed = 0;  ///< tries the world spoilt; those an operator broke off do not count
  bool operator==(const Visit&) const = default;
};

struct Preflight {};
struct Ramping {
  Visit visit;
};
struct Soaking {
  Visit visit;
};
struct Logging {
  Visit visit;
};
struct Paused {
  Visit visit;
};  ///< by an operator; the chamber holds
struct Holding {
  Visit visit;
  std::string why;
};  ///< a device is away
struct Returning {
  bool aborting = false;
};  ///< on the way to the safe temperature
struct Analysing {};
struct Finished {
  bool models = true;
};  ///< false: the dwells are stored, a model could not be made
struct Aborted {};
struct Safe {
  std::string why;
};  ///< a fault; latched, only a person re-arms it
using State = std::variant<Preflight, Ramping, Soaking, Logging, Paused, Holding, Returning,
                           Analysing, Finished, Aborted, Safe>;

struct Ready {
  Visit first;
};                      ///< preflight passed; where to begin
struct NothingLeft {};  ///< preflight passed; every setpoint has been visited
struct AtSetpoint {};   ///< the ramp is done, the air is in its band
struct Settled {};      ///< air and boards stable (stages A and B)
struct Unsettled {
  std::string why;
};                    ///< the longest soak is over and it is not stable
struct DwellDone {};  ///< every board has its samples
struct DwellShort {
  std::string why;
};  ///< some boards have theirs, others lost frames
struct DwellDisturbed {
  std::string why;
};  ///< spoilt for all boards
struct DeviceAway {
  std::string why;
};
struct DeviceBack {};
struct Restored {};  ///< the air is at the safe temperature
struct NotRestored {
  std::string why;
};  ///< it is not, and the wait for it is over
struct Analysed {
  bool models = true;
};
struct Fault {
  std::string why;
  bool hands_off = false;  ///< somebody else commands the chamber: it is not written to any more
};
struct PauseAsked {};
struct ResumeAsked {};
struct SkipAsked {};
struct AbortAsked {};
using Event =
    std::variant<Ready, NothingLeft, AtSetpoint, Settled, Unsettled, DwellDone, DwellShort,
                 DwellDisturbed, DeviceAway, DeviceBack, Restored, NotRestored, Analysed, Fault,
                 PauseAsked, ResumeAsked, SkipAsked, AbortAsked>;

struct RampTo {
  Celsius target;
};                   ///< software ramp from the air's temperature, run the chamber
struct HoldRamp {};  ///< leave the setpoint where it is
struct BeginDwell {
  Visit visit;
};
struct StoreDwell {};  ///< the collected group, each board judged by itself
struct RejectDwell {
  std::string reason;
};  ///< the group as far as it has come, marked
struct NoteSkip {
  Visit visit;
};                   ///< a group without samples, so that no later start goes back to it
struct MakeSafe {};  ///< safe setpoint at once; tried until the chamber confirms it
struct Analyse {};
struct Say {
  std::string severity;
  std::string kind;
  std::string text;
};  ///< an event row
using Action = std::variant<RampTo, HoldRamp, BeginDwell, StoreDwell, RejectDwell, NoteSkip,
                            MakeSafe, Analyse, Say>;

struct Step {
  State next;
  std::vector<Action> actions;
};

/// Why the dwells of a skipped setpoint are rejected.
inline constexpr char skipped[] = "skipped by an operator";

/// What follows from `event` in `state`. An event that is not awaited changes nothing and asks for
/// nothing: an operator's command is refused that way. Safe, Finished and Aborted have no
/// successor.
[[nodiscard]] Step step(const Plan& plan, const State& state, const Event& event);

/// "soaking": as stored in campaign.state and shown.
[[nodiscard]] const char* name(const State& state);

/// The names of all states, in the order of State.
[[nodiscard]] const std::array<std::string_view, std::variant_size_v<State>>& state_names();

/// ended(), by a state's name; false for a name that is none.
[[nodiscard]] bool has_ended(std::string_view state_name);

/// "soaking at 20.0 degC (point 13 of 25, attempt 2)": a sentence's subject.
[[nodiscard]] std::string describe(const Plan& plan, const State& state);

/// The setpoint a state is about, if it is about one.
[[nodiscard]] const Visit* visit_of(const State& state);

/// Estimate of the time from now to the end if nothing is disturbed. `here` is how long the
/// present state has lasted.
[[nodiscard]] Duration time_left(const Plan& plan, const State& state, Celsius air, Duration here);

/// Finished, Aborted or Safe: nothing follows.
[[nodiscard]] bool ended(const State& state);

}  // namespace gyrocal::campaign
