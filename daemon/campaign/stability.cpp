#include "daemon/campaign/stability.h"

#include <algorithm>
#include <cmath>

namespace gyrocal::campaign {
namespace {

/// Drops what is older than the window; one reading at or before its start stays, so that the
/// window is covered to its edge.
template <class Window>
void trim(Window& window, Duration oldest) {
  while (window.size() > 1 && window[1].t <= oldest) window.pop_front();
}

}  // namespace

void AirStability::start(Celsius setpoint) {
  setpoint_ = setpoint;
  band_since_.reset();
  window_.clear();
}

void AirStability::observe(Duration t, Celsius air) {
  if (std::abs((air - setpoint_).value) > limits_.air_band.value) {
    band_since_.reset();
    window_.clear();
    return;
  }
  if (!band_since_) band_since_ = t;
  window_.push_back({t, air});
  trim(window_, t - seconds(limits_.air_window_s));
}

Duration AirStability::in_band() const {
  return band_since_ ? window_.back().t - *band_since_ : Duration{};
}

Verdict AirStability::verdict(Duration t) const {
  if (window_.empty()) return Verdict::unstable;
  if (t - window_.back().t > unknown_after_) return Verdict::unknown;
  if (in_band() < seconds(limits_.air_window_s)) return Verdict::unstable;
  return peak_to_peak() <= limits_.air_peak_to_peak ? Verdict::stable : Verdict::unstable;
}

Kelvin AirStability::peak_to_peak() const {
  if (window_.empty()) return Kelvin{0};
  const auto [low, high] =
      std::minmax_element(window_.begin(), window_.end(),
                          [](const Reading& a, const Reading& b) { return a.air < b.air; });
  return high->air - low->air;
}

bool can_resolve_slope(Kelvin step, double slope_k_per_h, double window_s) {
  return step.value / (window_s / 3600) <= slope_k_per_h;
}

void BoardStability::start() {
  since_.reset();
  window_.clear();
}

void BoardStability::observe(Duration t, Celsius board) {
  if (!since_) since_ = t;
  window_.push_back({t, board});
  trim(window_, t - seconds(limits_.board_window_s));
}

std::optional<double> BoardStability::slope_k_per_h() const {
  if (!since_ || window_.back().t - *since_ < seconds(limits_.board_window_s)) return std::nullopt;
  double mean_h = 0;
  double mean_c = 0;
  const Duration origin = window_.front().t;
  const auto hours = [&](const Reading& r) { return to_seconds(r.t - origin) / 3600; };
  for (const Reading& r : window_) {
    mean_h += hours(r);
    mean_c += r.board.value;
  }
  mean_h /= double(window_.size());
  mean_c /= double(window_.size());
  double across = 0;
  double along = 0;
  for (const Reading& r : window_) {
    across += (hours(r) - mean_h) * (r.board.value - mean_c);
    along += (hours(r) - mean_h) * (hours(r) - mean_h);
  }
  if (along <= 0) return std::nullopt;
  return across / along;
}

Verdict BoardStability::verdict(Duration t) const {
  if (window_.empty() || t - window_.back().t > unknown_after_) return Verdict::unknown;
  const auto slope = slope_k_per_h();
  if (!slope) return Verdict::unstable;
  return std::abs(*slope) <= limits_.board_slope_k_per_h ? Verdict::stable : Verdict::unstable;
}

}  // namespace gyrocal::campaign
