#pragma once
#include <Eigen/Dense>
#include <limits>
#include <string>
#include <vector>

#include "tests/hidden_effects/slow_laws.h"

namespace hidden {

/// What a textbook would fit for one class: columns over a coarse grid of its shapes.
struct RivalClass {
  std::string name;
  Eigen::MatrixXd columns;  ///< bins x shapes
  /// What one column can be multiplied by: a lag is as large as the bias law makes it [deg/s at 1].
  double least_share = -std::numeric_limits<double>::infinity();
  double greatest_share = std::numeric_limits<double>::infinity();
};

/// Means over `bins` equal parts of the session.
Eigen::VectorXd binned(const Series& series, Eigen::Index bins);

/// All nine deterministic slow classes of the catalogue.
std::vector<RivalClass> textbook_rivals(const Trajectory& over, const Baseline& baseline,
                                        Eigen::Index bins);

}  // namespace hidden
