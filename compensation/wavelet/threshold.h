#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace gyrocal {

/// What becomes of a coefficient d at threshold T (|d| below T always becomes 0):
///   soft     sign(d) (|d| - T)    continuous, biased towards zero by T
///   hard     d                    unbiased, jumps at T
///   garrote  d - T^2/d            continuous, unbiased for |d| >> T (Gao 1998, nonnegative
///   garrote)
enum class Shrinkage { soft, hard, garrote };

/// How a band's threshold is found. All assume Gaussian noise of known deviation sigma.
///   universal  sigma sqrt(2 ln n)                        Donoho, Johnstone 1994
///   minimax    sigma (0.3936 + 0.1829 log2 n), 0 for n <= 32     the same, fitted to its Table 2
///   sure       minimum of Stein's unbiased risk of the band     Donoho, Johnstone 1995
///   bayes      sigma^2 / sqrt(mean d^2 - sigma^2)        Chang, Yu, Vetterli 2000 (BayesShrink)
/// n is the length of the signal, not of the band. sure and bayes look at each band alone and are
/// derived for soft shrinkage.
enum class ThresholdChoice { universal, sure, minimax, bayes };

/// Deviation of the noise in a band of wavelet details: median(|d|) / 0.67448975..., blind to few
/// large coefficients. 0 for an empty band. `scratch` is overwritten.
[[nodiscard]] double robust_sigma(std::span<const double> details, std::vector<double>& scratch);

/// @param details  one band, finite.
/// @param sigma    deviation of its noise, >= 0; 0 gives 0, except that bayes gives max|d| where
///                 the band holds nothing but noise (mean d^2 <= sigma^2).
[[nodiscard]] double threshold_of(ThresholdChoice choice, std::span<const double> details,
                                  double sigma, std::size_t signal_length,
                                  std::vector<double>& scratch);

/// Shrinks every coefficient in place.
void shrink(std::span<double> details, double threshold, Shrinkage shrinkage);

}  // namespace gyrocal
