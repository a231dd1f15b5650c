#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "compensation/discrepancy/dwell_data.h"

namespace gyrocal {

/// What the codes and values of the dwells say beside a Gaussian rounded to whole counts.
struct CodeFindings {
  bool quantised = false;   ///< the values are whole counts of lsb_dps
  double white_sd_dps = 0;  ///< robust, median over dwells, rounding taken off

  double holes_nats = 0;  ///< codes that never come though they should
  std::vector<std::int64_t> holes;
  int testable = 0;        ///< codes that should have come often enough to tell
  double holes_share = 0;  ///< of the codes that should come often enough to tell
  double holes_share_sd = 0;

  double upper_nats = 0, lower_nats = 0;  ///< mass at the last code, nothing beyond
  double upper_dps = 0, lower_dps = 0;    ///< the rail

  double outlier_nats = 0;
  std::int64_t outliers = 0;
  double outlier_share = 0, outlier_share_sd = 0;
  double outlier_size_sigma = 0;  ///< mean distance over the white noise
  bool outliers_one_sided = false;

  double stuck_nats = 0;
  std::int64_t stuck_runs = 0;
  double stuck_share = 0, stuck_share_sd = 0;
  double stuck_length = 0;  ///< mean repeats in a run

  double spread_nats = 0;  ///< ln sigma linear in die temperature
  double spread_percent_per_c = 0, spread_sd = 0;
  double spread_at_20_dps = 0;
  double growth_nats = 0;  ///< ln sigma linear in time, what temperature explains taken off
  double growth_percent_per_h = 0, growth_sd = 0;
  double middle_h = 0;  ///< mean time of the dwells: spread_at_20_dps is that of then

  double lost_nats = 0;
  std::int64_t lost = 0, expected = 0;
  double lost_burst = 0;  ///< mean frames lost in a row
};

/// @param dwells      those a fit may use.
/// @param two_levels  whether their noise jumps between two levels: then codes that a Gaussian
///   would reach need not come.
[[nodiscard]] CodeFindings inspect_codes(std::span<const DwellData> dwells, double lsb_dps,
                                         bool two_levels = false);

}  // namespace gyrocal
