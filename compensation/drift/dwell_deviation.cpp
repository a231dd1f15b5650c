#include "compensation/drift/dwell_deviation.h"

#include <cmath>

#include "compensation/drift/left_over.h"
#include "compensation/rig/random.h"
#include "compensation/values/assert.h"

namespace gyrocal {

Result<std::vector<DwellDeviation>> dwell_deviations(const WhiteDwells& dwells,
                                                     const DenoiseSettings& settings) {
  GYROCAL_ASSERT(dwells.samples > 1 && dwells.lsb_per_dps > 0);
  // Rounding to counts adds the variance of a uniform error: the noise is what is left below it.
  const double lsb_dps = 1 / dwells.lsb_per_dps;
  const double noise_variance =
      dwells.deviation_dps * dwells.deviation_dps - lsb_dps * lsb_dps / 12;
  GYROCAL_ASSERT(noise_variance >= 0);
  const double noise_dps = std::sqrt(noise_variance);
  rig::RandomStream random({.seed = dwells.seed});
  Denoiser denoiser(settings);
  Denoised filtered;
  std::vector<double> samples(static_cast<std::size_t>(dwells.samples));
  std::vector<DwellDeviation> deviations;
  for (int dwell = 0; dwell < dwells.dwells; ++dwell) {
    for (double& sample : samples) {
      const double rate = dwells.rate_dps + noise_dps * random.normal();
      sample = std::round(rate * dwells.lsb_per_dps) / dwells.lsb_per_dps;
    }
    if (auto done = denoiser.run(samples, filtered); !done) {
      return tl::unexpected(std::move(done.error()));
    }
    const LeftOver before = left_over(samples);
    const LeftOver after = left_over(filtered.denoised);
    deviations.push_back({before.standard_deviation_dps, after.standard_deviation_dps,
                          std::abs(after.mean_dps - before.mean_dps)});
  }
  return deviations;
}

}  // namespace gyrocal
