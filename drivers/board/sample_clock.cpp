#include "drivers/board/sample_clock.h"

#include <algorithm>
#include <cmath>

namespace gyrocal::inemo {
namespace {

constexpr double block_s = 8;
constexpr std::size_t blocks_max = 40;
constexpr double slope_from_s = 60;     // shorter records tell delays and crystals not apart
constexpr double crystal_max = 200e-6;  // 75 ppm have been seen on such boards
constexpr double late_periods = 1.5;
constexpr double late_for_s = 5;
constexpr int late_reads_min = 3;

}  // namespace

SampleClock::SampleClock(int rate_hz) : period_s_(1.0 / rate_hz) {}

void SampleClock::observe(std::uint32_t counter, Instant read_at) {
  if (!started_) {
    started_ = true;
    origin_ = read_at;
  }
  const double read_s = to_seconds(read_at - origin_);
  const Point point{static_cast<double>(counter), read_s - period_s_ * counter};
  if (judge_late(point, read_s)) return;
  add(point, read_s);
}

bool SampleClock::judge_late(Point point, double read_s) {
  if (earliest_.empty()) return false;
  const double late_s = point.late_s - edge_s(point.number);
  if (late_s <= late_periods * period_s_) {
    late_reads_ = 0;
    return false;
  }
  if (late_reads_ == 0) {
    late_since_s_ = read_s;
    late_least_s_ = late_s;
  }
  ++late_reads_;
  late_least_s_ = std::min(late_least_s_, late_s);
  if (late_reads_ < late_reads_min || read_s - late_since_s_ < late_for_s) return true;
  const double ticks = std::floor(late_least_s_ / period_s_ + 0.5);
  ticks_missed_ += static_cast<std::uint64_t>(ticks);
  for (Point& earlier : earliest_) earlier.late_s += ticks * period_s_;
  late_reads_ = 0;
  fit();
  return false;
}

void SampleClock::add(Point point, double read_s) {
  if (earliest_.empty() || read_s - block_start_s_ >= block_s) {
    block_start_s_ = read_s;
    earliest_.push_back(point);
    if (earliest_.size() > blocks_max) earliest_.erase(earliest_.begin());
    fit();
  } else if (point.late_s - edge_s(point.number) <
             earliest_.back().late_s - edge_s(earliest_.back().number)) {
    earliest_.back() = point;
    fit();
  }
}

void SampleClock::fit() {
  const double span_s = (earliest_.back().number - earliest_.front().number) * period_s_;
  slope_ = 0;
  if (span_s >= slope_from_s) {
    std::vector<Point> hull;
    for (const Point& point : earliest_) {
      const auto lies_above = [&] {
        const Point& a = hull[hull.size() - 2];
        const Point& b = hull.back();
        return (b.late_s - a.late_s) * (point.number - a.number) >=
               (point.late_s - a.late_s) * (b.number - a.number);
      };
      while (hull.size() >= 2 && lies_above()) hull.pop_back();
      hull.push_back(point);
    }
    double mean = 0;
    for (const Point& point : earliest_)
      mean += point.number / static_cast<double>(earliest_.size());
    auto right = std::find_if(hull.begin() + 1, hull.end() - 1,
                              [mean](const Point& point) { return point.number >= mean; });
    const Point& left = *(right - 1);
    slope_ = (right->late_s - left.late_s) / (right->number - left.number);
    slope_ = std::clamp(slope_, -crystal_max * period_s_, crystal_max * period_s_);
  }
  offset_s_ = earliest_.front().late_s - slope_ * earliest_.front().number;
  for (const Point& point : earliest_) {
    offset_s_ = std::min(offset_s_, point.late_s - slope_ * point.number);
  }
}

Instant SampleClock::time_of(std::uint32_t counter) const {
  const double number = counter;
  const double s = period_s_ * number + edge_s(number);
  return origin_ + Duration{std::llround(s * 1e9)};
}

}  // namespace gyrocal::inemo
