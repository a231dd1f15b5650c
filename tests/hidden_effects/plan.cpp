#include "tests/hidden_effects/plan.h"

#include <algorithm>

namespace hidden {
namespace {

std::vector<double> twenty_five() {
  std::vector<double> setpoints;
  double at = -10.0;
  while (at <= 50.0) {
    setpoints.push_back(at);
    at += setpoints.size() % 2 == 1 ? 3.0 : 2.0;
  }
  return setpoints;
}

std::vector<double> there_and_back(std::vector<double> setpoints) {
  const std::size_t n = setpoints.size();
  for (std::size_t i = n - 1; i-- > 0;) setpoints.push_back(setpoints[i]);
  return setpoints;
}

}  // namespace

Plan make_plan(const std::string& kind, Random& random) {
  Plan plan;
  plan.kind = kind;
  plan.setpoints_c = twenty_five();
  plan.start_c = random.uniform(19.0, 26.0);
  if (kind == "down") {
    std::reverse(plan.setpoints_c.begin(), plan.setpoints_c.end());
  } else if (kind == "up_down") {
    plan.setpoints_c = there_and_back(plan.setpoints_c);
  } else if (kind == "shuffled") {
    random.shuffle(plan.setpoints_c);
  } else if (kind == "up_revisit") {
    for (double again : {25.0, 0.0, 40.0, 10.0}) plan.setpoints_c.push_back(again);
  } else if (kind == "coarse") {
    plan.setpoints_c.clear();
    for (int i = 0; i < 9; ++i) plan.setpoints_c.push_back(-10.0 + 7.5 * i);
    plan.setpoints_c = there_and_back(plan.setpoints_c);
  } else if (kind == "single") {
    plan.setpoints_c = {random.uniform(10.0, 40.0)};
  } else if (kind == "dense") {
    plan.setpoints_c.clear();
    for (int i = 0; i <= 60; ++i) plan.setpoints_c.push_back(-10.0 + i);
    plan.soak_s = 600.0;
  }
  return plan;
}

}  // namespace hidden
