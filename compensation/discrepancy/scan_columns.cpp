#include "compensation/discrepancy/scan_columns.h"

#include <algorithm>
#include <cmath>

namespace gyrocal {

std::vector<ScanColumns> scan_columns(const SlowModel& model) {
  std::vector<ScanColumns> all;
  for (const rig::Effect& effect : rig::catalogue()) {
    if ((effect.channels & rig::slow_drift) == 0) continue;
    for (const auto& law : effect.laws) {
      ScanColumns entry{&effect, law.get(), trial_values(effect, *law, model.track()), {}};
      if (entry.rows.empty()) continue;
      entry.columns.resize(model.y().size(), static_cast<Eigen::Index>(entry.rows.size()));
      for (std::size_t i = 0; i < entry.rows.size(); ++i) {
        entry.columns.col(static_cast<Eigen::Index>(i)) = model.column(*law, entry.rows[i]);
      }
      all.push_back(std::move(entry));
    }
  }
  return all;
}

Eigen::VectorXd column_gains(const Eigen::MatrixXd& white, const Eigen::MatrixXd& off,
                             const Eigen::VectorXd& y_off) {
  const double rss = y_off.squaredNorm();
  const auto n = static_cast<double>(y_off.size());
  Eigen::VectorXd gain(off.cols());
  for (Eigen::Index i = 0; i < off.cols(); ++i) {
    const double norm2 = off.col(i).squaredNorm();
    const double share = norm2 > 1e-8 * white.col(i).squaredNorm()
                             ? std::pow(off.col(i).dot(y_off), 2) / (norm2 * rss)
                             : 0.0;
    gain(i) = -0.5 * n * std::log1p(-std::min(share, 1 - 1e-12));
  }
  return gain;
}

}  // namespace gyrocal
