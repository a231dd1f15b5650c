#include "tests/bench/peers.h"

namespace gyrocal::bench {

std::optional<double> gsl_transform_s(std::span<const double>) { return std::nullopt; }
std::string gsl_name() { return "GSL was not found at build time (apt install libgsl-dev)"; }

}  // namespace gyrocal::bench
