#include "compensation/discrepancy/null_gate.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "compensation/discrepancy/off_design.h"
#include "compensation/discrepancy/scan_columns.h"
#include "compensation/rig/random.h"

namespace gyrocal {
namespace {

constexpr Eigen::Index null_replicas = 100;
constexpr std::uint32_t null_purpose = 910;
constexpr double false_share = 0.01;
constexpr double tail_share = 0.2;
constexpr double refining_adds_nats = 1.0;

/// Whitened residuals of sessions without anything, one a column.
Eigen::MatrixXd null_residuals(const OffDesign& design, Eigen::Index bins) {
  rig::RandomStream noise({1, 0, 0, null_purpose});
  Eigen::MatrixXd white(bins, null_replicas);
  for (Eigen::Index r = 0; r < null_replicas; ++r) {
    for (Eigen::Index k = 0; k < bins; ++k) white(k, r) = noise.normal();
  }
  return design.off_white(white);
}

/// Where an exponential tail, fitted to the upper fifth, leaves `false_share` above.
double tail_point(std::vector<double> maxima) {
  std::sort(maxima.begin(), maxima.end());
  const auto n = static_cast<double>(maxima.size());
  const auto from = static_cast<std::size_t>((1 - tail_share) * n);
  double excess = 0;
  for (std::size_t i = from; i < maxima.size(); ++i) {
    excess += (maxima[i] - maxima[from - 1]) / (n - static_cast<double>(from));
  }
  return maxima[from - 1] + excess * std::log(tail_share / false_share);
}

}  // namespace

double null_gate_nats(const SlowModel& model) {
  const OffDesign design(model, model.fit().shape);
  const Eigen::MatrixXd residuals = null_residuals(design, model.y().size());
  const Eigen::RowVectorXd energy = residuals.colwise().squaredNorm();
  const auto n = static_cast<double>(model.y().size());
  std::vector<double> maxima(null_replicas, 0.0);
  for (const ScanColumns& entry : scan_columns(model)) {
    const Eigen::MatrixXd white = design.whitener().whiten(entry.columns);
    Eigen::MatrixXd off = design.off_white(white);
    for (Eigen::Index i = 0; i < off.cols(); ++i) {
      const double norm = off.col(i).norm();
      off.col(i) *= norm > 1e-4 * white.col(i).norm() ? 1 / norm : 0.0;
    }
    const Eigen::RowVectorXd best =
        (off.transpose() * residuals).array().square().colwise().maxCoeff();
    // Each shape parameter is paid for, as it is in the search.
    const auto paid = static_cast<double>(entry.rows.front().size() - 1);
    for (Eigen::Index r = 0; r < null_replicas; ++r) {
      const double gain = -0.5 * n * std::log1p(-best(r) / energy(r)) - paid;
      double& most = maxima[static_cast<std::size_t>(r)];
      most = std::max(most, gain);
    }
  }
  return tail_point(std::move(maxima)) + refining_adds_nats;
}

}  // namespace gyrocal
