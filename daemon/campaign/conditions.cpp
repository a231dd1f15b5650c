#include "daemon/campaign/conditions.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "daemon/campaign/overloaded.h"

namespace gyrocal::campaign {
namespace {

constexpr Kelvin restored_band{2};  ///< this close to the safe temperature a cabinet may be opened
constexpr double dwell_time_factor = 2;  ///< of the time its samples take at the nominal rate

constexpr Duration paused_for_max = std::chrono::hours{24};
constexpr double shortest_ramp_s = 300;  ///< shorter ones say little about a chamber
/// Of the rate asked for: air that still goes this fast is slow, not stuck.
constexpr double slow_share = 0.125;

Kelvin distance(Celsius a, Celsius b) { return Kelvin{std::abs((a - b).value)}; }

bool within(Celsius air, Celsius target, Kelvin band) { return distance(air, target) <= band; }

}  // namespace

Conditions::Conditions(const Plan& plan, Duration unknown_after)
    : plan_(plan),
      unknown_after_(unknown_after),
      air_stability_(plan.stability, unknown_after),
      boards_(plan.boards.size(), BoardState{BoardStability(plan.stability, unknown_after)}) {}

void Conditions::entered(const State& state, Duration t) {
  if (std::holds_alternative<Soaking>(state)) learn_from_ramp(t);
  since_ = t;
  air_then_ = air_;
  const Visit* visit = visit_of(state);
  heading_ = visit ? std::optional(plan_.setpoints[visit->point]) : std::nullopt;
  if (std::holds_alternative<Returning>(state)) heading_ = plan_.safe;
  nearer_at_ = t;
  if (heading_ && air_) nearest_ = distance(*air_, *heading_);
  if (!visit || target_ == plan_.setpoints[visit->point]) return;
  target_ = plan_.setpoints[visit->point];
  air_stability_.start(*target_);
  for (auto& board : boards_) board.stability.start();
}

void Conditions::learn_from_ramp(Duration t) {
  if (!target_ || !air_then_) return;
  const double expected_s = to_seconds(ramp_duration(plan_, *air_then_, *target_));
  if (expected_s < shortest_ramp_s) return;
  slowness_ = std::max(slowness_, to_seconds(t - since_) / expected_s);
}

void Conditions::air(Duration t, Celsius reading) {
  if (heading_ && !air_) nearest_ = distance(reading, *heading_);
  air_ = reading;
  const double step_k =
      slow_share * plan_.ramp_per_minute.value * plan_.limits.ramp_timeout_extra_s / 60;
  if (heading_ && distance(reading, *heading_).value <= nearest_.value - step_k) {
    nearest_ = distance(reading, *heading_);
    nearer_at_ = t;
  }
  if (!air_then_) air_then_ = reading;
  if (target_) air_stability_.observe(t, reading);
}

void Conditions::board_temperature(std::size_t board, Duration t, Celsius reading) {
  boards_.at(board).stability.observe(t, reading);
}

void Conditions::presence(std::size_t board, Presence presence) {
  boards_.at(board).presence = presence;
}

void Conditions::sensor_frozen(std::size_t board, bool frozen) {
  boards_.at(board).frozen = frozen;
}

std::optional<Event> Conditions::due(const State& state, Duration t) const {
  return std::visit(Overloaded{[&](const Ramping& s) { return while_ramping(s.visit, t); },
                               [&](const Soaking&) { return while_soaking(t); },
                               [&](const Logging& s) { return while_logging(s.visit, t); },
                               [&](const Returning&) { return while_returning(t); },
                               [&](const Paused&) -> std::optional<Event> {
                                 if (t - since_ <= paused_for_max) return std::nullopt;
                                 return Fault{"paused for more than a day"};
                               },
                               [](const auto&) -> std::optional<Event> { return std::nullopt; }},
                    state);
}

Soak Conditions::soak(std::size_t board) const {
  return {air_stability_.in_band(), timed(boards_.at(board))};
}

bool Conditions::timed(const BoardState& board) const {
  return board.frozen || !can_resolve_slope(board_sensor_step, plan_.stability.board_slope_k_per_h,
                                            plan_.stability.board_window_s);
}

bool Conditions::boards_settled(Duration t) const {
  return std::all_of(boards_.begin(), boards_.end(), [&](const BoardState& board) {
    return board.presence != Presence::expected || timed(board) ||
           board.stability.verdict(t) == Verdict::stable;
  });
}

std::optional<std::string> Conditions::missing_board() const {
  for (std::size_t i = 0; i < boards_.size(); ++i) {
    if (boards_[i].presence == Presence::away) return plan_.boards[i];
  }
  return std::nullopt;
}

Duration Conditions::ramp_bound(Celsius target) const {
  const Duration expected = ramp_duration(plan_, air_then_.value_or(target), target);
  return seconds(to_seconds(expected) * slowness_ * plan_.limits.ramp_timeout_factor +
                 plan_.limits.ramp_timeout_extra_s);
}

bool Conditions::too_long_on_the_way(Celsius target, Duration t) const {
  return t - since_ > ramp_bound(target) &&
         t - nearer_at_ > seconds(plan_.limits.ramp_timeout_extra_s);
}

std::optional<Event> Conditions::while_ramping(const Visit& visit, Duration t) const {
  const Celsius target = plan_.setpoints[visit.point];
  if (air_ && within(*air_, target, plan_.stability.air_band)) return AtSetpoint{};
  if (!air_ || !too_long_on_the_way(target, t))
    return std::nullopt;  // no reading: stale, elsewhere
  return Fault{
      fmt::format("the air is at {:.1f} degC and has not reached {:.1f} degC in {:.0f} min",
                  air_->value, target.value, to_seconds(t - since_) / 60)};
}

std::optional<Event> Conditions::while_soaking(Duration t) const {
  const bool air_settled = air_stability_.verdict(t) == Verdict::stable &&
                           air_stability_.in_band() >= seconds(plan_.stability.soak_s_min);
  if (air_settled && boards_settled(t)) {
    if (const auto board = missing_board()) return DeviceAway{"board " + *board + " is away"};
    return Settled{};
  }
  if (t - since_ <= seconds(plan_.stability.soak_s_max)) return std::nullopt;
  return Unsettled{fmt::format("not stable after {:.0f} min of soaking ({})",
                               to_seconds(t - since_) / 60,
                               air_settled ? "a board still drifts" : why_air_is_unsettled())};
}

std::string Conditions::why_air_is_unsettled() const {
  const Kelvin limit = plan_.stability.air_peak_to_peak;
  const Kelvin seen = air_stability_.peak_to_peak();
  if (seen <= limit) return "the air does not stay in its band";
  return fmt::format(
      "the air goes up and down by {:.2f} K within {:.0f} min, air_peak_to_peak_k allows {:.2f}",
      seen.value, plan_.stability.air_window_s / 60, limit.value);
}

std::optional<Event> Conditions::while_logging(const Visit& visit, Duration t) const {
  const Celsius target = plan_.setpoints[visit.point];
  if (air_ && !within(*air_, target, plan_.limits.dwell_band)) {
    return DwellDisturbed{fmt::format("the air left its band: {:.2f} degC at setpoint {:.1f} degC",
                                      air_->value, target.value)};
  }
  const double nominal_s = double(plan_.samples_per_dwell) / plan_.sample_rate_hz;
  const double bound_s = nominal_s * dwell_time_factor + plan_.limits.board_stale_s;
  if (t - since_ <= seconds(bound_s)) return std::nullopt;
  return DwellDisturbed{fmt::format("the samples did not come in {:.0f} s", bound_s)};
}

std::optional<Event> Conditions::while_returning(Duration t) const {
  const bool told = commanded_ == plan_.safe;
  if (told && air_ && within(*air_, plan_.safe, restored_band)) return Restored{};
  if (!told || !air_ || !too_long_on_the_way(plan_.safe, t)) return std::nullopt;
  return NotRestored{
      fmt::format("the air is at {:.1f} degC, not at the safe {:.1f} degC, {:.0f} "
                  "min after it was sent there; open the chamber with care",
                  air_->value, plan_.safe.value, to_seconds(t - since_) / 60)};
}

}  // namespace gyrocal::campaign
