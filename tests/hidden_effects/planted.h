#pragma once
#include <vector>

#include "tests/hidden_effects/hidden_case.h"
#include "tests/hidden_effects/identifiability.h"

namespace hidden {

/// A law put into a setting at some amplitude, with what it then does to the slow stream.
struct Planted {
  SlowLaw law;
  double amplitude;
  Series signature_dps;  ///< at amplitude one (for heat laws: linearised at the amplitude)
  double smallest;       ///< detectable amplitude
  Visibility seen;
};

/// What the law adds to the bias at amplitude one; a heat law is linearised at `amplitude`.
Series signature(const SlowLaw& law, const Setting& setting, const Trajectory& plain,
                 double amplitude);

/// The law at `factor` times the smallest amplitude its session can show.
/// @param plain  the setting's trajectory without effects. known: see Sight.
Planted plant(const SlowLaw& law, const Setting& setting, const Trajectory& plain, double factor,
              const std::vector<Series>& known, Random& random);

/// Within what the catalogue calls possible.
bool possible(const Planted& planted);

/// The session with all of them in it, its truth filled in but for category and verdicts.
Case assembled(const Setting& setting, const std::vector<Planted>& planted, std::uint64_t seed);

/// The weak flicker nobody should see: B at most 0.12 of the white noise of a 1/400 session,
/// where fitting it gains under one nat.
double weak_flicker_dps(const Setting& setting, const Trajectory& over);

}  // namespace hidden
