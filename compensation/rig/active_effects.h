#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "compensation/rig/effects/effect.h"
#include "compensation/rig/ou_noise.h"

namespace gyrocal::rig {

/// The effects that one axis of one board feels, running.
class AxisEffects {
 public:
  AxisEffects(const RigModel& model, std::span<const Instance> instances, std::uint64_t seed,
              std::uint32_t board, std::uint32_t axis, const CubicBias& bias);

  /// Physics has moved on to `now`; dt_s since the last call (0 at the first).
  void advance(const Drivers& now, double dt_s);
  /// Drift besides the baseline's bias [deg/s], and the factor on the white noise.
  [[nodiscard]] double drift_dps() const { return drift_dps_; }
  [[nodiscard]] double noise_factor() const { return noise_factor_; }

  /// Lines, levels, glitches: onto the rate before the ADC.
  void add(std::span<const double> t_s, double sigma_dps, std::span<double> rate_dps);
  /// The converter's own laws: codes given what the rates were.
  void convert(std::span<const double> exact_lsb, std::span<double> codes, double lsb_dps) const;
  /// What firmware does to codes afterwards.
  void change(std::span<double> codes);
  void lose(std::span<std::uint8_t> lost);

 private:
  struct Coded {
    const Law* law;
    std::vector<double> values;
  };
  std::vector<std::unique_ptr<Response>> responses_;
  std::vector<EmpiricalTerm> unexplained_;
  std::vector<OuNoise> noises_;
  std::vector<std::unique_ptr<SampleChange>> changes_;
  std::vector<Coded> laws_;
  double drift_dps_ = 0.0;
  double noise_factor_ = 1.0;
};

/// What a board feels as a whole: its tilt and its sensor's error.
class BoardEffects {
 public:
  BoardEffects(std::span<const Instance> instances, std::uint32_t board);
  [[nodiscard]] std::array<double, 3> specific_force_g(const Drivers& now) const;
  /// Once per instant, in order [degC].
  double sensor_error_c(const Drivers& now);
  /// Lines present now, of any axis.
  [[nodiscard]] std::vector<Line> lines(const Drivers& now) const;

 private:
  std::vector<Instance> instances_;
  std::vector<std::unique_ptr<Response>> readings_;
};

}  // namespace gyrocal::rig
