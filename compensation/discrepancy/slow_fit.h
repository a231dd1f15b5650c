#pragma once

#include <Eigen/Core>
#include <vector>

#include "compensation/discrepancy/slow_noise.h"

namespace gyrocal {

/// Which noise a fit may use.
struct NoiseFamily {
  bool flicker = false;
  bool walk = false;
  bool operator==(const NoiseFamily&) const = default;
};
inline constexpr NoiseFamily all_noise{.flicker = true, .walk = true};

/// A linear model of the slow stream, noise fitted with it.
struct SlowFit {
  double log_likelihood = 0;  ///< maximum over coefficients and noise [nat]
  SlowNoiseShape shape;
  double white_sd_dps = 0;         ///< of the mean over one second
  Eigen::VectorXd coefficients;    ///< one per column of the design
  Eigen::VectorXd standard_error;  ///< same units
};

/// Maximum likelihood of y = design * coefficients + noise for a given noise shape: coefficients
/// and white level are profiled out exactly.
/// @param y  n values [deg/s].  @param design  n x p, full column rank, n > p.
[[nodiscard]] SlowFit fit_given_shape(const SlowGrid& grid, const Eigen::VectorXd& y,
                                      const Eigen::MatrixXd& design, const SlowNoiseShape& shape);

/// Same, with the whitener of that shape at hand.
[[nodiscard]] SlowFit fit_whitened(const SlowWhitener& whitener, const SlowNoiseShape& shape,
                                   const Eigen::VectorXd& y, const Eigen::MatrixXd& design);

/// Same, over the noise shape too: a coarse scan, then a simplex search in the logarithms. A part
/// that does not help ends at exactly 0.
[[nodiscard]] SlowFit fit_noise(const SlowGrid& grid, const Eigen::VectorXd& y,
                                const Eigen::MatrixXd& design, const NoiseFamily& family);

/// Same, started from a shape already known to be near.
[[nodiscard]] SlowFit refit_noise(const SlowGrid& grid, const Eigen::VectorXd& y,
                                  const Eigen::MatrixXd& design, const NoiseFamily& family,
                                  const SlowNoiseShape& start);

}  // namespace gyrocal
