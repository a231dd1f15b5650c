#include "compensation/drift/held_out.h"

namespace gyrocal {
namespace {

DriftSeries without(const DriftSeries& whole, std::size_t point, std::size_t neighbours) {
  DriftSeries rest;
  rest.axis = whole.axis;
  std::vector<Eigen::Index> kept;
  for (std::size_t i = 0; i < whole.position.size(); ++i) {
    const bool held_out = i + neighbours >= point && i <= point + neighbours;
    if (held_out) continue;
    rest.position.push_back(whole.position[i]);
    kept.push_back(static_cast<Eigen::Index>(i));
  }
  rest.drift_dps = whole.drift_dps(kept);
  if (whole.weight.size() != 0) rest.weight = whole.weight(kept);
  return rest;
}

}  // namespace

Result<std::vector<double>> held_out_predictions(Method method, const DriftSeries& whole,
                                                 const MethodSettings& settings,
                                                 std::size_t neighbours) {
  std::vector<double> predictions;
  predictions.reserve(whole.position.size());
  for (std::size_t i = 0; i < whole.position.size(); ++i) {
    const auto curve = fit_method(method, without(whole, i, neighbours), settings);
    if (!curve) return tl::unexpected(curve.error());
    predictions.push_back(curve->at({whole.axis.setpoints_c[whole.position[i]]}));
  }
  return predictions;
}

}  // namespace gyrocal
