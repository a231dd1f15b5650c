#include "tests/faults/fault_schedule.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <cmath>
#include <iterator>
#include <optional>
#include <random>

namespace gyrocal::faults {
namespace {

constexpr std::size_t boards = 2;
constexpr double forever_s = 400'000;

class Draw {
 public:
  explicit Draw(std::uint64_t seed) : random_(seed) {}
  double uniform(double low, double high) {
    constexpr double two_to_53 = 9007199254740992.0;
    return low + (high - low) * static_cast<double>(random_() >> 11) / two_to_53;
  }
  double log_uniform(double low, double high) {
    return std::exp(uniform(std::log(low), std::log(high)));
  }
  std::size_t below(std::size_t count) { return random_() % count; }
  bool happens(double share) { return uniform(0, 1) < share; }
  template <class T, std::size_t n>
  const T& of(const T (&choice)[n]) {
    return choice[below(n)];
  }

 private:
  std::mt19937_64 random_;
};

std::string draw_campaign(Draw& draw) {
  std::vector<double> setpoints_c;
  for (auto n = 2 + draw.below(3); n > 0; --n) {
    setpoints_c.push_back(std::round(draw.uniform(-10, 50)));
  }
  return fmt::format(R"([campaign]
name = "faults"
simulated = true
[plan]
setpoints_c = [{}]
sweep = "as_listed"
samples_per_setpoint = 300
sample_rate_hz = 10
ramp_k_per_min = 2
safe_setpoint_c = 25
[chamber]
profile = "yinhe"
host = "127.0.0.1"
[[board]]
name = "left"
device = "/dev/left"
limit_min_c = -15
[[board]]
name = "right"
device = "/dev/right"
limit_max_c = 60
[stability]
air_window_s = 120
air_peak_to_peak_k = 0.4
board_window_s = 300
soak_s_min = 180
soak_s_max = 2400
[limits]
board_away_s_max = 1200
dwell_band_k = 0.5
[analysis]
level = 3
)",
                     fmt::join(setpoints_c, ", "));
}

Trigger draw_trigger(Draw& draw) {
  constexpr const char* states[] = {"ramping", "ramping", "soaking",   "soaking", "logging",
                                    "logging", "holding", "returning", "safe",    "paused"};
  if (draw.happens(0.2))
    return {"", 0, draw.happens(0.3) ? draw.uniform(0, 3) : draw.uniform(0, 9000)};
  return {draw.of(states), draw.below(4), draw.log_uniform(0.1, 300)};
}

/// Most outages are short enough to be lived with; a few never end.
double draw_duration(Draw& draw) {
  if (draw.happens(0.6)) return draw.log_uniform(0.5, 25);
  return draw.happens(0.03) ? forever_s : draw.log_uniform(25, 5000);
}

RigFault draw_chamber_fault(Draw& draw) {
  using Kind = RigFaultKind;
  constexpr Kind kinds[] = {Kind::refuse,         Kind::late,           Kind::lost,
                            Kind::half,           Kind::doubled,        Kind::exception,
                            Kind::wrong_unit,     Kind::wrong_register, Kind::wrong_value,
                            Kind::spurious_zero,  Kind::stuck,          Kind::dead,
                            Kind::panel_setpoint, Kind::panel_stop};
  RigFault fault;
  // Somebody's hand ends a campaign: rarer than the rest, or little else would be seen.
  fault.kind = kinds[draw.below(std::size(kinds) - (draw.happens(0.8) ? 3 : 0))];
  const bool at_an_instant = fault.kind == Kind::panel_setpoint || fault.kind == Kind::panel_stop;
  if (!at_an_instant) fault.for_s = draw_duration(draw);
  if (fault.kind == Kind::late) fault.value = draw.uniform(0.1, 3);
  if (fault.kind == Kind::exception) fault.value = double(1 + draw.below(6));
  if (fault.kind == Kind::wrong_value) fault.value = draw.uniform(-40, 40);
  if (fault.kind == Kind::panel_setpoint) fault.value = draw.uniform(-30, 80);
  return fault;
}

RigFault draw_board_fault(Draw& draw, std::size_t board) {
  using Kind = RigFaultKind;
  constexpr Kind kinds[] = {Kind::unplug, Kind::mute,  Kind::garbage,           Kind::duplicate,
                            Kind::drop,   Kind::reset, Kind::freeze_temperature};
  RigFault fault;
  fault.board = board;
  fault.kind = draw.of(kinds);
  if (fault.kind != Kind::reset) fault.for_s = draw_duration(draw);
  if (fault.kind == Kind::freeze_temperature) fault.for_s = forever_s;
  fault.value = draw.happens(0.2) ? 1.0 : draw.log_uniform(0.001, 0.5);  // a share of frames
  return fault;
}

HostFault draw_host_fault(Draw& draw) {
  using Kind = HostFaultKind;
  constexpr Kind kinds[] = {Kind::stopped,   Kind::slept, Kind::clock_step, Kind::disk_little,
                            Kind::disk_full, Kind::crash, Kind::crash,      Kind::power_cut,
                            Kind::pause,     Kind::skip,  Kind::abort,      Kind::sigterm};
  HostFault fault{draw.of(kinds), draw.log_uniform(0.5, 5000), 0};
  if (fault.kind == Kind::pause && draw.happens(0.1)) fault.for_s = forever_s;
  if (fault.kind == Kind::clock_step) {
    fault.value = (draw.happens(0.5) ? 1 : -1) * draw.log_uniform(1, 100'000);
  }
  if (fault.kind == Kind::crash || fault.kind == Kind::power_cut) {
    fault.value = double(draw.below(200));
    fault.for_s = draw.log_uniform(2, 3000);
  }
  return fault;
}

/// Up to three faults at about the same time on a link.
template <class DrawFault>
void draw_cluster(Draw& draw, const Trigger& when, const DrawFault& one,
                  std::vector<PlannedFault>& into) {
  if (draw.happens(0.4)) return;
  for (auto n = 1 + draw.below(3); n > 0; --n) {
    Trigger at = when;
    at.after_s += draw.happens(0.5) ? 0 : draw.uniform(0, 30);
    into.push_back({at, one()});
  }
}

}  // namespace

Schedule draw_schedule(std::uint64_t seed) {
  Draw draw(seed);
  Schedule schedule;
  schedule.campaign = draw_campaign(draw);
  schedule.tick = std::chrono::seconds{draw.happens(0.8) ? 5 : 1};
  const double speed = draw.log_uniform(0.5, 3);
  auto& chamber = schedule.model.baseline.chamber;
  chamber.heating_c_per_min *= speed;
  chamber.cooling_c_per_min *= speed;
  chamber.approach_tau_s /= speed;
  if (draw.happens(0.05)) return schedule;
  for (auto n = 1 + draw.below(3); n > 0; --n) {
    const Trigger when = draw_trigger(draw);
    auto& faults = schedule.faults;
    draw_cluster(
        draw, when, [&] { return draw_chamber_fault(draw); }, faults);
    for (std::size_t i = 0; i < boards; ++i) {
      draw_cluster(
          draw, when, [&] { return draw_board_fault(draw, i); }, faults);
    }
    if (draw.happens(0.4)) faults.push_back({when, draw_host_fault(draw)});
  }
  return schedule;
}

namespace {

const char* name_of(RigFaultKind kind) {
  constexpr const char* names[] = {"refuse",         "late",           "lost",
                                   "half",           "doubled",        "exception",
                                   "wrong_unit",     "wrong_register", "wrong_value",
                                   "spurious_zero",  "stuck",          "dead",
                                   "panel_setpoint", "panel_stop",     "unplug",
                                   "mute",           "garbage",        "duplicate",
                                   "drop",           "reset",          "freeze_temperature"};
  return names[static_cast<std::size_t>(kind)];
}

const char* name_of(HostFaultKind kind) {
  constexpr const char* names[] = {"stopped",   "slept", "clock_step", "disk_little",
                                   "disk_full", "crash", "power_cut",  "pause",
                                   "skip",      "abort", "sigterm"};
  return names[static_cast<std::size_t>(kind)];
}

}  // namespace

std::string to_text(const Schedule& schedule) {
  std::string text =
      fmt::format("chamber at {:.2f} K/min, tick {} s\n",
                  schedule.model.baseline.chamber.heating_c_per_min, to_seconds(schedule.tick));
  for (const PlannedFault& planned : schedule.faults) {
    const Trigger& when = planned.when;
    text += when.state.empty() ? fmt::format("  at {:.1f} s: ", when.after_s)
                               : fmt::format("  {:.1f} s after {} at point {}: ", when.after_s,
                                             when.state, when.point + 1);
    if (const auto* rig = std::get_if<RigFault>(&planned.fault)) {
      text += rig->board ? fmt::format("board {} ", *rig->board) : "chamber ";
      text += fmt::format("{} for {:.1f} s, value {:.3f}\n", name_of(rig->kind), rig->for_s,
                          rig->value);
    } else {
      const auto& host = std::get<HostFault>(planned.fault);
      text += fmt::format("{} for {:.1f} s, value {:.1f}\n", name_of(host.kind), host.for_s,
                          host.value);
    }
  }
  return text;
}

}  // namespace gyrocal::faults
