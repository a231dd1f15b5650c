#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "compensation/discrepancy/segments.h"
#include "compensation/discrepancy/track.h"
#include "compensation/values/records.h"

namespace gyrocal {

/// The samples of one dwell, the dwell's own mean and slope taken off: the slow stream alone
/// carries means.
struct DwellData {
  int dwell = 0;
  double t_start_s = 0;
  double die_c = 0;    ///< mean over the dwell
  double cooling = 0;  ///< share of the dwell during which the air was being cooled
  double mean_dps = 0;
  double slope_dps_per_s = 0;
  std::vector<double> t_s;
  std::vector<double> y_dps;         ///< as measured
  std::vector<double> residual_dps;  ///< y - mean - slope (t - middle)
  std::vector<std::int64_t> seq;
  std::array<double, 3> acc_mean_g{missing, missing, missing};
};

/// Dwells with at least `samples_min` samples, kept-out ones only or all but them.
[[nodiscard]] std::vector<DwellData> dwell_data(const Session& session,
                                                std::span<const Segment> segments,
                                                const Track& track, bool held_out);

}  // namespace gyrocal
