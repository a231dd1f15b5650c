#pragma once

#include <Eigen/Core>
#include <vector>

namespace gyrocal {

[[nodiscard]] inline std::vector<double> list_of(const Eigen::VectorXd& v) {
  return {v.begin(), v.end()};
}

}  // namespace gyrocal
