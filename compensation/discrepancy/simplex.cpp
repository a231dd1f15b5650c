#include "compensation/discrepancy/simplex.h"

#include <algorithm>
#include <vector>

#include "compensation/values/assert.h"

namespace gyrocal {
namespace {

struct Corner {
  Eigen::VectorXd at;
  double value;
};

bool better(const Corner& a, const Corner& b) { return a.value < b.value; }

}  // namespace

SimplexResult minimise(const std::function<double(const Eigen::VectorXd&)>& function,
                       const Eigen::VectorXd& start, const Eigen::VectorXd& step, double tolerance,
                       int evaluations_max) {
  const Eigen::Index dimensions = start.size();
  GYROCAL_ASSERT(dimensions >= 1 && step.size() == dimensions);
  int evaluations = 0;
  const auto corner_at = [&](const Eigen::VectorXd& at) {
    ++evaluations;
    return Corner{at, function(at)};
  };
  std::vector<Corner> corners{corner_at(start)};
  for (Eigen::Index i = 0; i < dimensions; ++i) {
    Eigen::VectorXd at = start;
    at(i) += step(i);
    corners.push_back(corner_at(at));
  }
  std::stable_sort(corners.begin(), corners.end(), better);
  while (evaluations < evaluations_max &&
         corners.back().value - corners.front().value > tolerance) {
    Eigen::VectorXd centre = Eigen::VectorXd::Zero(dimensions);
    for (std::size_t i = 0; i + 1 < corners.size(); ++i) centre += corners[i].at;
    centre /= static_cast<double>(dimensions);
    Corner& worst = corners.back();
    const Eigen::VectorXd away = centre - worst.at;
    const Corner reflected = corner_at(centre + away);
    if (better(reflected, corners.front())) {
      const Corner expanded = corner_at(centre + 2 * away);
      worst = better(expanded, reflected) ? expanded : reflected;
    } else if (better(reflected, corners[corners.size() - 2])) {
      worst = reflected;
    } else {
      const bool outside = better(reflected, worst);
      const Corner contracted = corner_at(centre + (outside ? 0.5 : -0.5) * away);
      if (better(contracted, outside ? reflected : worst)) {
        worst = contracted;
      } else {
        for (std::size_t i = 1; i < corners.size(); ++i) {
          corners[i] = corner_at(0.5 * (corners[0].at + corners[i].at));
        }
      }
    }
    std::stable_sort(corners.begin(), corners.end(), better);
  }
  return {corners.front().at, corners.front().value, evaluations};
}

}  // namespace gyrocal
