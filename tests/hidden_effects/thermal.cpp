#include "tests/hidden_effects/thermal.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace hidden {
namespace {

enum Node { air, board, die, lag_first, lag_second, warm_fast, warm_slow, node_count };
using Nodes = std::array<double, node_count>;

constexpr double approach_s = 90.0;  // how the chamber's controller eases into a setpoint

struct Drive {
  double setpoint_c;
  double ripple_c;
};

Nodes slopes(const Nodes& at, const Drive& drive, const Plan& plan, const Chain& chain) {
  Nodes slope{};
  slope[air] = std::clamp((drive.setpoint_c - at[air]) / approach_s,
                          -plan.ramp_down_c_per_min / 60.0, plan.ramp_up_c_per_min / 60.0);
  slope[board] = (at[air] + drive.ripple_c - at[board]) / chain.board_tau_s;
  slope[die] = (at[board] - at[die]) / chain.die_tau_s;
  if (chain.extra_lag_s > 0.0) {
    slope[lag_first] = (at[die] - at[lag_first]) / (0.5 * chain.extra_lag_s);
    slope[lag_second] = (at[lag_first] - at[lag_second]) / (0.5 * chain.extra_lag_s);
  }
  slope[warm_fast] = (1.0 - at[warm_fast]) / chain.self_heat_s;
  slope[warm_slow] = (1.0 - at[warm_slow]) / (4.0 * chain.self_heat_s);
  return slope;
}

Nodes moved(const Nodes& from, const Nodes& slope, double step_s) {
  Nodes to = from;
  for (std::size_t i = 0; i < to.size(); ++i) to[i] += step_s * slope[i];
  return to;
}

/// The chamber's cycling: not quite a sine, and its period wanders by a few per cent.
class Ripple {
 public:
  Ripple(const Chain& chain, Random& random)
      : chain_(chain), random_(random), phase_(random.uniform(0.0, 2.0 * std::numbers::pi)) {}

  double value(double ahead_s) const {
    const double phase = phase_ + speed() * ahead_s;
    return chain_.ripple_c * (std::sin(phase) + 0.15 * std::sin(2.0 * phase));
  }
  bool falling() const { return std::cos(phase_) + 0.3 * std::cos(2.0 * phase_) < 0.0; }
  void advance(double step_s) {
    phase_ += speed() * step_s;
    stretch_ +=
        step_s * (-stretch_ / 1800.0) + 0.04 * std::sqrt(2.0 * step_s / 1800.0) * random_.normal();
  }

 private:
  double speed() const {
    return 2.0 * std::numbers::pi / (chain_.ripple_period_s * std::exp(stretch_));
  }
  Chain chain_;
  Random& random_;
  double phase_;
  double stretch_ = 0.0;
};

struct Now {
  Nodes nodes;
  double setpoint_c;
};

void record(const Now& now, const Ripple& ripple, const Chain& chain, Trajectory& into) {
  const Nodes& at = now.nodes;
  const double warm_c = chain.self_heat_c * (0.8 * at[warm_fast] + 0.2 * at[warm_slow]);
  into.setpoint_c.push_back(now.setpoint_c);
  into.air_c.push_back(at[air] + ripple.value(0.0));
  into.board_c.push_back(at[board] + chain.self_heat_on_board * warm_c);
  into.die_c.push_back(at[die]);
  into.rate_c_per_min.push_back(60.0 * (at[board] - at[die]) / chain.die_tau_s);
  into.felt_c.push_back((chain.extra_lag_s > 0.0 ? at[lag_second] : at[die]) + warm_c);
  const double ahead_c = now.setpoint_c - at[air];
  into.compressor_on.push_back(ahead_c < -0.5 || (ahead_c < 0.5 && ripple.falling()) ? 1 : 0);
}

void step(Now& now, Ripple& ripple, const Plan& plan, const Chain& chain, double step_s) {
  const auto drive = [&](double ahead_s) { return Drive{now.setpoint_c, ripple.value(ahead_s)}; };
  const double half_s = 0.5 * step_s;
  const Nodes k1 = slopes(now.nodes, drive(0.0), plan, chain);
  const Nodes k2 = slopes(moved(now.nodes, k1, half_s), drive(half_s), plan, chain);
  const Nodes k3 = slopes(moved(now.nodes, k2, half_s), drive(half_s), plan, chain);
  const Nodes k4 = slopes(moved(now.nodes, k3, step_s), drive(step_s), plan, chain);
  for (std::size_t i = 0; i < node_count; ++i) {
    now.nodes[i] += step_s / 6.0 * (k1[i] + 2.0 * k2[i] + 2.0 * k3[i] + k4[i]);
  }
  ripple.advance(step_s);
}

}  // namespace

Trajectory simulate_temperatures(const Plan& plan, const Chain& chain, double dwell_s,
                                 Random& random) {
  Ripple ripple(chain, random);
  Now now{{}, plan.start_c};
  for (Node node : {air, board, die, lag_first, lag_second}) now.nodes[node] = plan.start_c;
  Trajectory out;
  const auto one_second = [&] {
    record(now, ripple, chain, out);
    step(now, ripple, plan, chain, 0.5);
    step(now, ripple, plan, chain, 0.5);
  };
  const auto travel_to = [&](double setpoint_c) {
    now.setpoint_c = setpoint_c;
    do {
      one_second();
    } while (std::abs(now.nodes[air] - setpoint_c) > 0.2);
  };
  for (double setpoint_c : plan.setpoints_c) {
    travel_to(setpoint_c);
    for (double waited_s = 0.0; waited_s < plan.soak_s; waited_s += 1.0) one_second();
    out.dwells.push_back({setpoint_c, static_cast<double>(out.seconds())});
    for (double spent_s = 0.0; spent_s < dwell_s + 2.0; spent_s += 1.0) one_second();
  }
  if (plan.log_return) travel_to(plan.start_c);
  return out;
}

}  // namespace hidden
