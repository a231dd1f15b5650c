#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "compensation/values/error.h"
#include "compensation/wavelet/boundary.h"
#include "compensation/wavelet/filter_bank.h"

namespace gyrocal {

/// What a decomposition is made with.
struct Wavelet {
  const FilterBank* bank;  ///< from find_filter_bank(); never null
  Boundary boundary = Boundary::symmetric;
  int level = 1;
};

/// The coefficients of a multilevel decomposition, back to back, coarse to fine: cA_L, cD_L, ...,
/// cD_1 (the paper's vectors C and L, Fig. 3).
struct Decomposition {
  std::vector<double> coefficients;
  std::vector<std::size_t> lengths;  ///< of the L + 1 bands, then of the signal
  [[nodiscard]] int level() const { return static_cast<int>(lengths.size()) - 2; }
  [[nodiscard]] std::size_t bands() const { return lengths.size() - 1; }
  /// Band 0 is cA_L, band 1 is cD_L, the last one cD_1.
  [[nodiscard]] std::span<const double> band(std::size_t index) const;
  [[nodiscard]] std::span<double> band(std::size_t index);
};

/// Memory that repeated calls share; its contents mean nothing between calls.
struct Workspace {
  std::vector<double> here;
  std::vector<double> there;
};

/// floor(log2(n)): a coefficient one level deeper would stand for more samples than there are.
/// 0 for n < 2.
[[nodiscard]] int deepest_level(std::size_t signal_length);

/// floor(log2(n / (taps - 1))), at least 0: deeper, every coefficient has seen an end of the signal
/// (what PyWavelets and MATLAB call the maximum level; both go on, and so do we).
[[nodiscard]] int useful_level(std::size_t signal_length, std::size_t taps);

/// @return nothing if `wavelet` can be applied to n samples; too_few_points for n < 2; out_of_range
/// for a level outside 1..deepest_level(n).
[[nodiscard]] Result<void> check_level(std::size_t signal_length, int level);

/// Multilevel discrete wavelet transform (Mallat's pyramid), the same numbers as PyWavelets'
/// wavedec. O(n taps).
/// @param signal  n samples; NaN passes through.
/// @return the coefficients; errors of check_level().
[[nodiscard]] Result<Decomposition> decompose(std::span<const double> signal,
                                              const Wavelet& wavelet);

/// The same for a level already checked, without allocation once `workspace` and `to` have grown.
void decompose_into(std::span<const double> signal, const Wavelet& wavelet, Workspace& workspace,
                    Decomposition& to);

/// Inverse of decompose(): as many samples as the signal had, equal to it up to rounding.
/// @param from  made by decompose() with this wavelet and boundary, values changed at will.
[[nodiscard]] std::vector<double> reconstruct(const Decomposition& from, const Wavelet& wavelet);
void reconstruct_into(const Decomposition& from, const Wavelet& wavelet, Workspace& workspace,
                      std::vector<double>& signal);

/// The part of the signal that stems from one band alone (the paper's wrcoef): the sum over all
/// bands is the signal. Band 0 is the approximation cA_L, the last one the detail cD_1.
[[nodiscard]] std::vector<double> reconstruct_branch(const Decomposition& from,
                                                     const Wavelet& wavelet, std::size_t band);
void reconstruct_approximation_into(const Decomposition& from, const Wavelet& wavelet,
                                    Workspace& workspace, std::vector<double>& signal);

}  // namespace gyrocal
