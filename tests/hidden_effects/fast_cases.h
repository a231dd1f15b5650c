#pragma once
#include <string>

#include "tests/hidden_effects/hidden_case.h"

namespace hidden {

/// One effect that shows in spectra, distributions, the link or another channel.
Case fast_single(const std::string& name, const std::string& level, std::uint64_t seed);

/// A fast effect added to a case that already hides a slow one: other channels, both to be named.
Case with_fast(Case slow, const std::string& name, std::uint64_t seed);

/// Nothing hidden: white noise, rounding, and at most a flicker below every limit.
Case null_case(std::uint64_t seed, const std::string& plan);

/// Noise that grows with time and not with temperature: of no catalogue.
Case tiring_noise_case(std::uint64_t seed);

std::vector<std::string> fast_names();

}  // namespace hidden
