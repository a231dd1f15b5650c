#pragma once
#include <string>

#include "tests/hidden_effects/slow_laws.h"

namespace hidden {

// The laws that remember where the temperature has been.

/// @param form  bouc_wen | preisach | play_spectrum. Amplitude: h of the catalogue, half the
/// gap between the branches.
SlowLaw thermal_hysteresis(const std::string& form, Random& random);

/// A water film that grows by its own area while the air is above the dew point and the board
/// below it, and dries slowly. Amplitude: bias under a whole film.
SlowLaw condensation_step(Random& random);

/// @param form  stretched (three relaxation times around one) | two_glues (two far apart).
/// Amplitude: the bias a sudden step of one degree makes at once.
SlowLaw stress_relaxation(const std::string& form, Random& random);

}  // namespace hidden
