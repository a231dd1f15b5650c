#pragma once
#include <Eigen/Dense>
#include <string>
#include <vector>

#include "tests/hidden_effects/slow_laws.h"

namespace hidden {

/// What a textbook would fit for one class: columns over a coarse grid of its shapes.
struct RivalClass {
  std::string name;
  Eigen::MatrixXd columns;  ///< bins x shapes
};

/// Means over `bins` equal parts of the session.
Eigen::VectorXd binned(const Series& series, Eigen::Index bins);

/// All nine deterministic slow classes of the catalogue.
std::vector<RivalClass> textbook_rivals(const Trajectory& over, const Baseline& baseline,
                                        Eigen::Index bins);

}  // namespace hidden
