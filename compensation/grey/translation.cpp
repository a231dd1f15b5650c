#include "compensation/grey/translation.h"

#include <algorithm>
#include <cmath>

namespace gyrocal {
namespace {

double ratio_limit(Eigen::Index n) { return std::exp(2.0 / static_cast<double>(n + 1)); }

}  // namespace

double translation_for(const Eigen::Ref<const Eigen::VectorXd>& drift_dps) {
  if (drift_dps.size() == 0 || drift_dps.minCoeff() > 0) return 0;
  const double low = drift_dps.minCoeff();
  const double range = drift_dps.maxCoeff() - low;
  const double limit = ratio_limit(drift_dps.size());
  double least = -low;
  for (Eigen::Index k = 1; k < drift_dps.size(); ++k) {
    const double higher = std::max(drift_dps(k - 1), drift_dps(k));
    const double lower = std::min(drift_dps(k - 1), drift_dps(k));
    least =
        std::max(least, (higher - limit * lower) / (limit - 1));  // (higher+c)/(lower+c) = limit
  }
  // A constant series <= 0 has no range to give a scale: any positive level serves.
  return least + (range > 0 ? range : 1.0);
}

ClassRatios class_ratios(const Eigen::Ref<const Eigen::VectorXd>& drift_dps) {
  ClassRatios found;
  found.high = ratio_limit(drift_dps.size());
  found.low = 1 / found.high;
  for (Eigen::Index k = 1; k < drift_dps.size(); ++k) {
    const double ratio = drift_dps(k - 1) / drift_dps(k);
    found.ratio.push_back(ratio);
    if (!(ratio > found.low && ratio < found.high)) {
      found.outside.push_back(static_cast<std::size_t>(k));
    }
  }
  return found;
}

}  // namespace gyrocal
