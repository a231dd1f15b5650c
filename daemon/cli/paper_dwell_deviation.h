#pragma once

#include <cstdint>

namespace gyrocal::cli {

/// `gyrocal paper --dwell-deviation`: what the paper's filter leaves of simulated dwells, level by
/// level, beside the paper's 1.3102 and 0.2488 deg/s. Returns the exit code.
int report_dwell_deviation(std::uint64_t seed, bool as_json);

}  // namespace gyrocal::cli
