#include <Eigen/Core>

#include "compensation/grey/improved_gm11.h"
#include "compensation/grey/polynomial.h"
#include "tests/bench/measure.h"
#include "tests/bench/python_peer.h"
#include "tests/bench/sections.h"

namespace gyrocal::bench {
namespace {

void append(const Eigen::VectorXd& values, std::vector<double>& to) {
  to.insert(to.end(), values.begin(), values.end());
}

/// Table 1 of the paper [deg/s].
const std::vector<double> table{4.3839, 4.3385, 4.3299, 4.3432, 4.3422, 4.3063, 4.2786,
                                4.1863, 4.2251, 4.2074, 4.1455, 4.0979, 4.1039, 4.0913,
                                4.0717, 4.0666, 4.1113, 4.1327, 4.0645, 4.0228, 4.0872,
                                4.0612, 4.0708, 4.0811, 4.043};

}  // namespace

Rows fit_rows() {
  const SignalPeer peer({{"fit_25", table}});
  const Eigen::VectorXd drift =
      Eigen::Map<const Eigen::VectorXd>(table.data(), static_cast<Eigen::Index>(table.size()));
  const Eigen::VectorXd index = plain_index(drift.size());
  std::vector<double> fitted;
  const Spread ours = time_of_call_s([&] {
    fitted.clear();
    append(fit_gm11(drift).value().fitted_dps, fitted);
    append(fit_improved_gm11(drift).value().fitted_dps, fitted);
    const Polynomial cubic = fit_polynomial(index, drift, 3).value();
    for (const double k : index) fitted.push_back(value_at(cubic, k));
  });
  return {against("the three fits at 25 setpoints", ours, peer.numpy("fit_25"), 10,
                  peer.difference("fit_25", fitted))};
}

}  // namespace gyrocal::bench
