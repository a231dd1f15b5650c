#include "compensation/rig/rig_board.h"

#include <algorithm>
#include <cmath>

#include "compensation/values/assert.h"

namespace gyrocal::rig {
namespace {

constexpr std::int64_t grid_ns = 200'000'000;
constexpr double grid_s = 0.2;

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
      noise_(noise_streams(seed, board_index)) {
  for (std::size_t axis = 0; axis < 3; ++axis) drift_dps_[axis] = bias_[axis].at(thermals_.die_c());
  temperature_raw_ = sensor_register(thermals_.board_c(), baseline_.board_sensor_step_c);
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
  thermals_.advance(grid_s, air.at(static_cast<double>(grid_index_) * grid_s).value);
  for (std::size_t axis = 0; axis < 3; ++axis) drift_dps_[axis] = bias_[axis].at(thermals_.die_c());
  temperature_raw_ = sensor_register(thermals_.board_c(), baseline_.board_sensor_step_c);
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
  out.reserve(out.size() + static_cast<std::size_t>(count));
  while (count > 0) {
    const std::int64_t first_ns = next_sample_ns();
    reach_grid(air, first_ns);
    const double left_s = static_cast<double>((grid_index_ + 1) * grid_ns - first_ns) * 1e-9;
    // At least one, at most what fits before the next grid instant; one too few costs only a loop.
    const auto fitting = std::max<std::int64_t>(1, static_cast<std::int64_t>(left_s * rate_hz_));
    const std::int64_t now = std::min(count, fitting);
    take_within_step(now, out);
    count -= now;
  }
}

void RigBoard::take_within_step(std::int64_t count, std::vector<RigSample>& out) {
  const double limit = baseline_.code_limit;
  for (std::int64_t i = 0; i < count; ++i) {
    RigSample& sample = out.emplace_back();
    sample.t_ns = next_sample_ns();
    sample.temperature_raw = temperature_raw_;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double dps = drift_dps_[axis] + baseline_.noise_dps * noise_[axis].normal();
      const double code = std::floor(dps * baseline_.lsb_per_dps + 0.5);
      sample.gyro_lsb[axis] = static_cast<std::int16_t>(std::clamp(code, -limit, limit));
    }
    ++taken_;
  }
}

void RigBoard::take_until(const ChamberAir& air, std::int64_t t_ns, std::vector<RigSample>& out) {
  if (rate_hz_ == 0.0 || t_ns < next_sample_ns()) return;
  const double due = static_cast<double>(t_ns - start_ns_) * 1e-9 * rate_hz_;
  take(air, std::max<std::int64_t>(0, static_cast<std::int64_t>(due) - taken_), out);
  while (next_sample_ns() <= t_ns) take(air, 1, out);
}

}  // namespace gyrocal::rig
