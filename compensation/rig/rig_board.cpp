#include "compensation/rig/rig_board.h"

#include <algorithm>
#include <cmath>

#include "compensation/values/assert.h"

namespace gyrocal::rig {
namespace {

constexpr std::int64_t grid_ns = 200'000'000;
constexpr double grid_s = 0.2;
constexpr std::size_t longest_block = 128;

std::array<CubicBias, 3> with_spread(const Baseline& baseline, std::uint64_t seed,
                                     std::uint32_t board) {
  auto bias = baseline.bias;
  if (board == 0) return bias;
  for (std::uint32_t axis = 0; axis < 3; ++axis) {
    RandomStream random({seed, board, axis, board_spread});
    bias[axis].dps[0] += baseline.bias_spread_dps * random.normal();
  }
  return bias;
}

std::array<RandomStream, 3> noise_streams(std::uint64_t seed, std::uint32_t board) {
  return {RandomStream({seed, board, 0, white_noise}), RandomStream({seed, board, 1, white_noise}),
          RandomStream({seed, board, 2, white_noise})};
}

std::vector<Instance> checked(const RigModel& model) {
  auto instances = instantiate(model);
  GYROCAL_ASSERT(instances.has_value());
  return std::move(*instances);
}

std::int16_t sensor_register(double board_c, double step_c) {
  const double shown_c = std::floor(board_c / step_c + 0.5) * step_c;
  return static_cast<std::int16_t>(std::lround(std::clamp(shown_c, -55.0, 125.0) * 256.0));
}

}  // namespace

RigBoard::RigBoard(const RigModel& model, std::uint64_t seed, std::uint32_t board_index)
    : baseline_(model.baseline),
      thermals_(model.baseline.board_tau_s, model.baseline.die_tau_s,
                model.baseline.chamber.ambient_c),
      bias_(with_spread(model.baseline, seed, board_index)),
      noise_(noise_streams(seed, board_index)),
      board_effects_(checked(model), board_index) {
  const auto instances = checked(model);
  for (std::uint32_t axis = 0; axis < 3; ++axis) {
    axis_effects_.emplace_back(model, instances, seed, board_index, axis, bias_[axis]);
  }
  const double ambient_c = model.baseline.chamber.ambient_c;
  drivers_.setpoint_c = drivers_.chamber_c = ambient_c;
  feel(0.0);
}

void RigBoard::start(std::int64_t t_ns, double rate_hz) {
  GYROCAL_ASSERT(rate_hz > 0.0 && t_ns >= grid_index_ * grid_ns);
  start_ns_ = t_ns;
  rate_hz_ = rate_hz;
  taken_ = 0;
}

std::int64_t RigBoard::next_sample_ns() const {
  GYROCAL_ASSERT(rate_hz_ > 0.0);
  return start_ns_ + std::llround(static_cast<double>(taken_) * 1e9 / rate_hz_);
}

void RigBoard::step_grid(const ChamberAir& air) {
  ++grid_index_;
  const double t_s = static_cast<double>(grid_index_ * grid_ns) * 1e-9;
  drivers_.t_s = t_s;
  drivers_.setpoint_c = air.setpoint_at(t_s).value;
  drivers_.chamber_c = air.at(t_s).value;
  drivers_.chamber_rate_c_per_min = air.rate_c_per_min(t_s);
  thermals_.advance(grid_s, drivers_.chamber_c);
  feel(grid_s);
}

/// Temperatures stand at the new instant: what do board and axes make of it?
void RigBoard::feel(double dt_s) {
  const std::int64_t on_ns = grid_index_ * grid_ns - power_on_ns_;
  drivers_.t_on_s = std::max(0.0, static_cast<double>(on_ns) * 1e-9);
  drivers_.board_c = thermals_.board_c();
  drivers_.die_c = thermals_.die_c();
  drivers_.die_rate_c_per_min = thermals_.die_rate_c_per_min();
  drivers_.acc_g = board_effects_.specific_force_g(drivers_);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    axis_effects_[axis].advance(drivers_, dt_s);
    drift_dps_[axis] = bias_[axis].at(drivers_.die_c) + axis_effects_[axis].drift_dps();
  }
  const double shown_c = drivers_.board_c + board_effects_.sensor_error_c(drivers_);
  temperature_raw_ = sensor_register(shown_c, baseline_.board_sensor_step_c);
}

void RigBoard::reach_grid(const ChamberAir& air, std::int64_t t_ns) {
  while ((grid_index_ + 1) * grid_ns <= t_ns) step_grid(air);
}

void RigBoard::advance(const ChamberAir& air, std::int64_t t_ns) { reach_grid(air, t_ns); }

std::int16_t RigBoard::temperature_raw(const ChamberAir& air, std::int64_t t_ns) {
  reach_grid(air, t_ns);
  return temperature_raw_;
}

void RigBoard::take(const ChamberAir& air, std::int64_t count, std::vector<RigSample>& out) {
  GYROCAL_ASSERT(count >= 0);
  while (count > 0) {
    const std::int64_t first_ns = next_sample_ns();
    reach_grid(air, first_ns);
    const double left_s = static_cast<double>((grid_index_ + 1) * grid_ns - first_ns) * 1e-9;
    // At least one, at most what fits before the next grid instant; one too few costs only a loop.
    const auto fitting = std::max<std::int64_t>(1, static_cast<std::int64_t>(left_s * rate_hz_));
    const std::int64_t now = std::min({count, fitting, static_cast<std::int64_t>(longest_block)});
    take_within_step(static_cast<std::size_t>(now), out);
    count -= now;
  }
}

void RigBoard::take_within_step(std::size_t count, std::vector<RigSample>& out) {
  std::array<double, longest_block> t_s;
  std::array<std::uint8_t, longest_block> lost{};
  const std::size_t first = out.size();
  for (std::size_t i = 0; i < count; ++i, ++taken_) {
    RigSample& sample = out.emplace_back();
    sample.t_ns = next_sample_ns();
    sample.temperature_raw = temperature_raw_;
    t_s[i] = static_cast<double>(sample.t_ns) * 1e-9;
  }
  const std::span<RigSample> block(out.data() + first, count);
  for (std::size_t axis = 0; axis < 3; ++axis) take_axis(axis, {t_s.data(), count}, block);
  axis_effects_[0].lose({lost.data(), count});
  for (std::size_t i = 0; i < count; ++i) block[i].lost = lost[i] != 0;
}

void RigBoard::take_axis(std::size_t axis, std::span<const double> t_s, std::span<RigSample> out) {
  std::array<double, longest_block> rate;  // deg/s, then LSB
  std::array<double, longest_block> code;
  const std::size_t count = t_s.size();
  AxisEffects& effects = axis_effects_[axis];
  const double sigma_dps = baseline_.noise_dps * effects.noise_factor();
  for (std::size_t i = 0; i < count; ++i) {
    rate[i] = drift_dps_[axis] + sigma_dps * noise_[axis].normal();
  }
  effects.add(t_s, sigma_dps, {rate.data(), count});
  for (std::size_t i = 0; i < count; ++i) {
    rate[i] *= baseline_.lsb_per_dps;
    code[i] = std::floor(rate[i] + 0.5);
  }
  effects.convert({rate.data(), count}, {code.data(), count}, 1.0 / baseline_.lsb_per_dps);
  const double limit = baseline_.code_limit;
  for (std::size_t i = 0; i < count; ++i) code[i] = std::clamp(code[i], -limit, limit);
  effects.change({code.data(), count});
  for (std::size_t i = 0; i < count; ++i) {
    out[i].gyro_lsb[axis] = static_cast<std::int16_t>(code[i]);
  }
}

void RigBoard::take_until(const ChamberAir& air, std::int64_t t_ns, std::vector<RigSample>& out) {
  if (rate_hz_ == 0.0 || t_ns < next_sample_ns()) return;
  const double due = static_cast<double>(t_ns - start_ns_) * 1e-9 * rate_hz_;
  take(air, std::max<std::int64_t>(0, static_cast<std::int64_t>(due) - taken_), out);
  while (next_sample_ns() <= t_ns) take(air, 1, out);
}

}  // namespace gyrocal::rig
