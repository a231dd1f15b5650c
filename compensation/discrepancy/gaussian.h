#pragma once

namespace gyrocal {

/// Share of a Gaussian beyond z standard deviations.
[[nodiscard]] double upper_tail(double z);

/// The z below which a Gaussian has this share, 0 < share < 1. Error < 1e-9.
[[nodiscard]] double normal_quantile(double share);

}  // namespace gyrocal
