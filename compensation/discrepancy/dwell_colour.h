#pragma once

#include <span>

#include "compensation/discrepancy/dwell_data.h"
#include "compensation/discrepancy/dwell_spectrum.h"

namespace gyrocal {

/// Spectral shape of the dwells' noise by Whittle's likelihood, K dwells averaged.
struct DwellColour {
  double flicker_nats = 0;  ///< gain of white + 1/f over white
  double relax_nats = 0;    ///< gain of white + one Lorentzian over white
  double relax_tau_s = 0;
  double relax_share = 0;  ///< Lorentzian's variance over the white variance
};
[[nodiscard]] DwellColour dwell_colour(const DwellSpectrum& spectrum);

/// Two-level switching in the samples, by a hidden Markov model.
struct TelegraphFit {
  double nats = 0;               ///< gain over white noise
  double lead_nats = 0;          ///< over Ornstein-Uhlenbeck + white, which has the same spectrum
  double flicker_lead_nats = 0;  ///< over flicker + white
  double level_dps = 0;          ///< distance of the two levels
  double level_sd_dps = 0;
  double low_dwell_s = 0;
  double high_dwell_s = 0;
  double white_sd_dps = 0;
};

/// Baum-Welch from several starts (it sticks in local optima), each dwell with its own mean level.
/// Samples that stand alone beyond `clip_sd` deviations are pulled in: a glitch is no level.
[[nodiscard]] TelegraphFit fit_telegraph(std::span<const DwellData> dwells, double sample_rate_hz);

}  // namespace gyrocal
