#pragma once
#include <string>

#include "tests/hidden_effects/hidden_case.h"

namespace hidden {

/// One effect of the slow stream, sized by what its own session can show: strong is 5 to 10 times,
/// moderate 2.5 to 3 times the amplitude that gains 10 nats, on a plan where no other class of the
/// catalogue comes within 10 nats.
Case slow_single(const std::string& name, const std::string& level, std::uint64_t seed,
                 double sigma_over_lsb_min);

/// Two strong slow effects, each 10 nats clear of every class even with the other known.
Case slow_pair(const std::string& first, const std::string& second, std::uint64_t seed);

/// An effect of no catalogue, 25 nats clear of every class of it.
Case outsider_case(const std::string& law, std::uint64_t seed);

/// An effect seen clearly, but on a plan where some other class explains it within 5 nats. Beyond
/// 3 nats, chance can clear it, and naming it is accepted too.
/// @param plans  where that can happen; straight: the bias over temperature is a line.
Case confounded_case(const std::string& name, const std::vector<std::string>& plans, bool straight,
                     std::uint64_t seed);

/// The plan on which an effect can be told from its rivals.
std::vector<std::string> telling_plans(const std::string& name);

}  // namespace hidden
