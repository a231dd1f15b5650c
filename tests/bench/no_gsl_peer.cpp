#include "tests/bench/gsl_peer.h"

namespace gyrocal::bench {

Peer gsl_round_trip(std::span<const double>) { return {"GSL", {}, "libgsl-dev, then build"}; }

}  // namespace gyrocal::bench
