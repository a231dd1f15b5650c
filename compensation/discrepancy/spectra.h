#pragma once

#include <span>
#include <vector>

#include "compensation/discrepancy/gap.h"

namespace gyrocal {

/// Mean spectra of the kept-out dwells: as measured, and as simulated dwells of a state of the
/// model have them. Frequencies from above 0 to half the sample rate, at most some 400.
/// @return one point a frequency, simulated ones in the order of `simulations`; empty if no dwell
/// is
///   kept out or the dwells are too short.
struct SpectrumPoint {
  double f_hz = 0;
  double measured_dps2_per_hz = 0;  ///< one-sided
  std::vector<double> simulated_dps2_per_hz;
};
[[nodiscard]] std::vector<SpectrumPoint> compare_spectra(const Session& session,
                                                         std::span<const Segment> segments,
                                                         const Track& track,
                                                         std::span<const Simulation> simulations);

}  // namespace gyrocal
