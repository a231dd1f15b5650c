#pragma once

#include <span>

#include "tests/bench/row.h"

namespace gyrocal::bench {

/// GSL's full-depth db4 transform of 2^k samples there and back; absent if built without GSL.
[[nodiscard]] Peer gsl_round_trip(std::span<const double> signal);

}  // namespace gyrocal::bench
