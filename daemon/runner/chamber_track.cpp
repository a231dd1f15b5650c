#include "daemon/runner/chamber_track.h"

#include <algorithm>

namespace gyrocal::runner {

void ChamberTrack::observe(Duration t, Celsius actual, Celsius setpoint) {
  readings_.push_back({t, actual, setpoint});
}

void ChamberTrack::forget_before(Duration t) {
  while (readings_.size() > 1 && readings_[1].t <= t) readings_.pop_front();
}

std::optional<Celsius> ChamberTrack::mean(Duration from, Duration to) const {
  return mean(from, to, gap_max_);
}

std::optional<Celsius> ChamberTrack::mean(Duration from, Duration to, Duration gap_max) const {
  double area = 0;
  Duration covered = from;
  for (std::size_t i = 1; i < readings_.size() && covered < to; ++i) {
    const Reading& a = readings_[i - 1];
    const Reading& b = readings_[i];
    if (b.t <= covered) continue;
    if (a.t > covered || b.t - a.t > gap_max) return std::nullopt;
    const Duration end = std::min(b.t, to);
    const auto at = [&](Duration t) {
      return a.actual.value +
             (b.actual - a.actual).value * to_seconds(t - a.t) / to_seconds(b.t - a.t);
    };
    area += 0.5 * (at(covered) + at(end)) * to_seconds(end - covered);
    covered = end;
  }
  if (covered < to || to <= from) return std::nullopt;
  return Celsius{area / to_seconds(to - from)};
}

std::optional<Celsius> ChamberTrack::dwell_mean(Duration from, Duration to) const {
  if (readings_.empty() || to - readings_.back().t > dwell_gap_max_) return std::nullopt;
  if (readings_.back().t <= from) return readings_.back().actual;
  return mean(from, std::min(to, readings_.back().t), dwell_gap_max_);
}

std::optional<Kelvin> ChamberTrack::peak_to_peak(Duration from, Duration to) const {
  std::optional<Celsius> low;
  std::optional<Celsius> high;
  for (const Reading& r : readings_) {
    if (r.t < from || r.t > to) continue;
    low = low ? std::min(*low, r.actual) : r.actual;
    high = high ? std::max(*high, r.actual) : r.actual;
  }
  if (!low) return std::nullopt;
  return *high - *low;
}

std::optional<Celsius> ChamberTrack::setpoint(Duration t) const {
  std::optional<Celsius> found;
  for (const Reading& r : readings_) {
    if (r.t > t) break;
    if (t - r.t <= gap_max_) found = r.setpoint;
  }
  return found;
}

std::optional<Duration> ChamberTrack::latest() const {
  if (readings_.empty()) return std::nullopt;
  return readings_.back().t;
}

}  // namespace gyrocal::runner
