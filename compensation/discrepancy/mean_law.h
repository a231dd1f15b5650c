#pragma once

#include <cstdint>
#include <limits>
#include <vector>

namespace gyrocal {

/// What becomes of the mean of many noisy samples in the converter: rounding to whole codes, codes
/// that never come, rails. With noise of less than half a count rounding alone pulls means by up
/// to 0.15 counts (effects.md, section 2), and a hole or a rail pulls them at any noise.
class MeanLaw {
 public:
  struct Converter {
    double lsb_dps = 0;  ///< 0: continuous
    double sd_dps = 0;   ///< white noise per sample
    std::vector<std::int64_t> holes;
    double lower_dps = -std::numeric_limits<double>::infinity();
    double upper_dps = std::numeric_limits<double>::infinity();
  };
  /// @param low, high  range of true means [deg/s] that will be asked for.
  MeanLaw(const Converter& converter, double low, double high);

  /// Mean of the samples where the true rate is `rate_dps`.
  [[nodiscard]] double measured(double rate_dps) const;
  /// The true rate whose samples have this mean.
  [[nodiscard]] double rate(double measured_dps) const;
  /// Whether the rate is nearer to a rail than a deviation of the noise, or beyond it: the mean no
  /// longer tells it well.
  [[nodiscard]] bool is_lost(double measured_dps) const;
  /// Whether it changes anything at all.
  [[nodiscard]] bool bends() const { return !rate_.empty(); }

 private:
  double lowest_told_dps_ = -std::numeric_limits<double>::infinity();
  double highest_told_dps_ = std::numeric_limits<double>::infinity();
  std::vector<double> rate_, measured_;  // table; empty: the identity
};

}  // namespace gyrocal
