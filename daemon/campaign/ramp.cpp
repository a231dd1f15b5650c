#include "daemon/campaign/ramp.h"

#include <algorithm>
#include <cmath>

namespace gyrocal::campaign {
namespace {

constexpr Duration write_interval = std::chrono::minutes{1};
constexpr double resolution_k = 0.1;  ///< of the chamber's panel; finer steps only wear its memory

}  // namespace

std::optional<Celsius> SetpointRamp::due(Duration t) const {
  if (finished()) return std::nullopt;
  if (written_at_ && t - *written_at_ < write_interval) return std::nullopt;
  const double minutes = to_seconds(t - start_ + write_interval) / 60;
  const double span = (target_ - from_).value;
  const double travelled = std::min(minutes * per_minute_.value, std::abs(span));
  if (travelled >= std::abs(span)) return target_;
  const double exact = from_.value + std::copysign(travelled, span);
  const Celsius rounded{std::round(exact / resolution_k) * resolution_k};
  if (rounded == last_) return std::nullopt;
  return rounded;
}

void SetpointRamp::written(Duration t, Celsius setpoint) {
  written_at_ = t;
  last_ = setpoint;
}

}  // namespace gyrocal::campaign
