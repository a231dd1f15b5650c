#pragma once

#include <span>
#include <vector>

#include "compensation/discrepancy/dwell_data.h"

namespace gyrocal {

/// A shorter dwell has no spectrum.
inline constexpr std::size_t spectrum_samples_min = 64;

/// Periodograms of several dwells over one frequency axis, each bin over its smooth background:
/// white noise of any level has mean 1, and the sum over K dwells is Gamma(K).
struct DwellSpectrum {
  double bin_hz = 0;  ///< twice as fine as 1/length, so that no line falls between bins
  int dwells = 0;
  int samples = 0;                        ///< used of each dwell
  double density_dps2 = 0;                ///< white variance per sample: the median background
  std::vector<double> mean;               ///< over dwells, per bin, over background
  std::vector<double> background;         ///< over density_dps2
  std::vector<std::vector<double>> each;  ///< [dwell][bin], over background
};

/// Lost samples count as the dwell's mean. Dwells are cut to the shortest common length.
[[nodiscard]] DwellSpectrum dwell_spectrum(std::span<const DwellData> dwells,
                                           double sample_rate_hz);

/// A narrow feature standing out of the background.
struct SpectralLine {
  double f_hz = 0;
  double width_hz = 0;               ///< of the bins that hold it
  double amplitude_dps = 0;          ///< of a sine, rms over dwells
  double amplitude_when_on_dps = 0;  ///< power-weighted: in the dwells that have it
  double nats = 0;                   ///< gain over no line, the number of places tried taken off
  double gating = 0;                 ///< correlation of the line's power with the chamber's cooling
};

/// Lines, strongest first, each taken out before the next is looked for; none below `nats_min`.
[[nodiscard]] std::vector<SpectralLine> find_lines(const DwellSpectrum& spectrum,
                                                   std::span<const DwellData> dwells,
                                                   double nats_min);

/// Where a frequency appears when sampled.
[[nodiscard]] double folded_hz(double f_hz, double sample_rate_hz);

}  // namespace gyrocal
