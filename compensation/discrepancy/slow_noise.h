#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

namespace gyrocal {

/// Noise of the slow stream relative to its white part: what the likelihood searches over.
/// Ratios are variances over the white variance of one second, so that the white level itself can
/// be profiled out.
struct SlowNoiseShape {
  double flicker_ratio = 0;  ///< B^2 / sigma_w^2, two-sided S(f) = B^2 / (2 pi f)
  double walk_ratio = 0;     ///< K^2 / sigma_w^2 [1/s], variance K^2 t after t seconds
  bool operator==(const SlowNoiseShape&) const = default;
};

/// When each bin of the slow stream was taken and how much of its width holds data.
struct SlowGrid {
  std::vector<double> t_s;  ///< centres, ascending
  std::vector<double>
      weight_s;  ///< seconds of samples in the mean; white variance goes as 1/weight
};

/// The exact Gaussian likelihood of white + flicker + random walk on an uneven grid, in O(n): a
/// Kalman filter whose states are Ornstein-Uhlenbeck processes, one per half-decade of time
/// constant (their sum is 1/f over the campaign's range), and one random walk. Its scaled
/// innovations are the whitened columns.
/// Source: effects.md (bias_instability, rate_random_walk); IEEE Std 952 for the two spectra.
class SlowWhitener {
 public:
  /// @param grid  n >= 2 bins.
  SlowWhitener(const SlowGrid& grid, const SlowNoiseShape& shape);

  /// Replaces each column (length n) by its whitened innovations: for data of this noise with
  /// sigma_w = 1 they are independent with unit variance. O(n * columns * states).
  [[nodiscard]] Eigen::MatrixXd whiten(const Eigen::Ref<const Eigen::MatrixXd>& columns) const;

  /// Sum over the bins of the logarithm of the innovation variance for sigma_w = 1.
  [[nodiscard]] double log_determinant() const { return log_determinant_; }

  /// Flicker time constants [s] in use on a grid of this span, a half-decade apart.
  [[nodiscard]] static std::vector<double> flicker_tau_s(const SlowGrid& grid);

 private:
  std::size_t states_ = 0;
  std::vector<double> decay_;  // n x states: what is left of each state since the bin before
  std::vector<double> gain_;   // n x states
  std::vector<double> inverse_sd_;
  double log_determinant_ = 0;
};

}  // namespace gyrocal
