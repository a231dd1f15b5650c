#include "compensation/drift/setpoint_means.h"

#include <fmt/core.h>

#include <cmath>
#include <map>

namespace gyrocal {

Result<SetpointMeans> setpoint_means(const DriftTable& dwells,
                                     const std::vector<double>& standard_error_dps) {
  const std::size_t n = dwells.temperature_c.size();
  const bool weighted = !standard_error_dps.empty();
  if (dwells.zero_drift_dps.size() != n || (weighted && standard_error_dps.size() != n)) {
    return fail(Errc::bad_input,
                fmt::format("{} setpoints, {} zero drifts, {} standard errors", n,
                            dwells.zero_drift_dps.size(), standard_error_dps.size()),
                "give as many of each");
  }
  struct Sum {
    double weight = 0;
    double weighted_dps = 0;
  };
  std::map<double, Sum> at;
  for (std::size_t i = 0; i < n; ++i) {
    const double error = weighted ? standard_error_dps[i] : 1.0;
    if (!std::isfinite(dwells.temperature_c[i]) || !std::isfinite(dwells.zero_drift_dps[i]) ||
        !(error > 0 && std::isfinite(error))) {
      return fail(Errc::bad_input,
                  fmt::format("dwell {}: setpoint {} degC, zero drift {} deg/s, standard error {}",
                              i + 1, dwells.temperature_c[i], dwells.zero_drift_dps[i], error),
                  "reject the dwell or repeat it");
    }
    Sum& sum = at[dwells.temperature_c[i]];
    sum.weight += 1 / (error * error);
    sum.weighted_dps += dwells.zero_drift_dps[i] / (error * error);
  }
  SetpointMeans means;
  for (const auto& [setpoint_c, sum] : at) {
    means.table.temperature_c.push_back(setpoint_c);
    means.table.zero_drift_dps.push_back(sum.weighted_dps / sum.weight);
    if (weighted) means.standard_error_dps.push_back(1 / std::sqrt(sum.weight));
  }
  return means;
}

}  // namespace gyrocal
