#include "compensation/firmware/comparison.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace gyrocal {
namespace {

constexpr double float_tolerance_dps = 1e-4;
constexpr int probes = 2001;

}  // namespace

Result<ExportLoss> compared(const Comparison& way) {
  ExportLoss loss;
  loss.axis = way.axis.identity.axis;
  const auto& setpoints = way.axis.curve.axis.setpoints_c;
  double squares = 0;
  for (int i = 0; i < probes; ++i) {
    const double wanted_c =
        setpoints.front() + (setpoints.back() - setpoints.front()) * i / (probes - 1);
    const auto t = static_cast<float>(wanted_c);
    const double form = way.form(t);
    const double difference = form - way.axis.curve.at({t});
    loss.form_max_dps = std::max(loss.form_max_dps, std::abs(difference));
    squares += difference * difference;
    loss.float_max_dps =
        std::max(loss.float_max_dps, std::abs(static_cast<double>(way.text(t)) - form));
  }
  loss.form_rms_dps = std::sqrt(squares / probes);
  // Written so that a NaN fails too.
  if (!(loss.float_max_dps <= float_tolerance_dps)) {
    return fail(Errc::mismatch,
                fmt::format("axis {}: the text read back and evaluated in single precision is {} "
                            "deg/s off what was to be written (at most {})",
                            loss.axis, loss.float_max_dps, float_tolerance_dps),
                "nothing was written; another format may hold this model");
  }
  return loss;
}

}  // namespace gyrocal
