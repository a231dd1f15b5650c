#include "compensation/rig/chamber_air.h"

#include <algorithm>
#include <cmath>

#include "compensation/rig/portable_math.h"
#include "compensation/values/assert.h"

namespace gyrocal::rig {

ChamberAir::ChamberAir(const ChamberPhysics& physics) : physics_(physics) {
  segments_.push_back({0.0, physics.ambient_c, physics.ambient_c, false, 0.0});
}

void ChamberAir::run(double t_s, Celsius setpoint) {
  GYROCAL_ASSERT(std::isfinite(setpoint.value));
  const Segment& now = segments_.back();
  append({t_s, without_cycling(now, t_s), setpoint.value, true,
          now.running ? now.cycling_since_s : t_s});
}

void ChamberAir::stop(double t_s) { append({t_s, at(t_s).value, physics_.ambient_c, false, t_s}); }

void ChamberAir::append(Segment next) {
  GYROCAL_ASSERT(next.t_s >= segments_.back().t_s);
  segments_.push_back(next);
}

const ChamberAir::Segment& ChamberAir::segment_at(double t_s) const {
  if (t_s >= segments_.back().t_s) return segments_.back();
  const auto later = std::upper_bound(segments_.begin(), segments_.end(), t_s,
                                      [](double t, const Segment& s) { return t < s.t_s; });
  return later == segments_.begin() ? segments_.front() : *(later - 1);
}

double ChamberAir::without_cycling(const Segment& segment, double t_s) const {
  const double elapsed_s = std::max(0.0, t_s - segment.t_s);
  const double gap = segment.target_c - segment.start_c;
  if (!segment.running) {
    return segment.target_c - gap * portable_exp(-elapsed_s / physics_.ambient_tau_s);
  }
  const double limit_c_per_s =
      (gap >= 0 ? physics_.heating_c_per_min : physics_.cooling_c_per_min) / 60.0;
  const double approach_c = limit_c_per_s * physics_.approach_tau_s;  // where the limit lets go
  const double limited_s = std::max(0.0, (std::abs(gap) - approach_c) / limit_c_per_s);
  const double direction = gap >= 0 ? 1.0 : -1.0;
  if (elapsed_s < limited_s) return segment.start_c + direction * limit_c_per_s * elapsed_s;
  const double left = gap - direction * limit_c_per_s * limited_s;
  return segment.target_c - left * portable_exp(-(elapsed_s - limited_s) / physics_.approach_tau_s);
}

Celsius ChamberAir::at(double t_s) const {
  const Segment& segment = segment_at(t_s);
  const double smooth_c = without_cycling(segment, t_s);
  if (!segment.running) return {smooth_c};
  const double turns = (t_s - segment.cycling_since_s) / physics_.cycling_period_s;
  return {smooth_c + physics_.cycling_c * portable_sine(turns)};
}

double ChamberAir::rate_c_per_min(double t_s) const {
  const Segment& segment = segment_at(t_s);
  const double left = segment.target_c - without_cycling(segment, t_s);
  if (!segment.running) return left / physics_.ambient_tau_s * 60.0;
  const double smooth = std::clamp(left / physics_.approach_tau_s * 60.0,
                                   -physics_.cooling_c_per_min, physics_.heating_c_per_min);
  const double turns = (t_s - segment.cycling_since_s) / physics_.cycling_period_s;
  const double cosine = portable_sine(turns + 0.25);
  return smooth + physics_.cycling_c * cosine * two_pi / physics_.cycling_period_s * 60.0;
}

bool ChamberAir::running_at(double t_s) const { return segment_at(t_s).running; }

Celsius ChamberAir::setpoint_at(double t_s) const { return {segment_at(t_s).target_c}; }

}  // namespace gyrocal::rig
