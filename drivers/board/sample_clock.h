#pragma once

#include <cstdint>
#include <vector>

#include "drivers/clock.h"

namespace gyrocal::inemo {

/// When the board took each sample, from frame numbers and the times at which frames were read.
/// Pure.
///
/// The board samples at a steady rate of its own crystal; whatever delays a frame only adds. So the
/// line t = a + b n runs along the *lower edge* of the points (number, time read): of all lines
/// that no point lies below, the one nearest to the points, i.e. the edge of their lower hull above
/// the mean number. b is the nominal period until a minute has passed and stays within 200 ppm of
/// it. Points are the earliest of every 8 s; the last 40 count.
///
/// The firmware's counter rises only when a frame is built, so instants that it slept through leave
/// no gap in it. They show as frames that stay late: once every read for 5 s was more than 1.5
/// periods late, the line is moved up by as many periods and they are counted.
class SampleClock {
 public:
  explicit SampleClock(int rate_hz);

  /// The newest frame of one read: older ones of the same read only waited longer.
  void observe(std::uint32_t counter, Instant read_at);
  /// Needs one observed frame.
  [[nodiscard]] Instant time_of(std::uint32_t counter) const;
  [[nodiscard]] std::uint64_t ticks_missed() const { return ticks_missed_; }

 private:
  struct Point {
    double number;
    double late_s;  ///< time read minus the nominal time of the number
  };
  void add(Point point, double read_s);
  void fit();
  bool judge_late(Point point, double read_s);
  [[nodiscard]] double edge_s(double number) const { return offset_s_ + slope_ * number; }

  double period_s_;
  Instant origin_{};  ///< read time of the first observed frame
  double block_start_s_ = 0;
  std::vector<Point> earliest_;  ///< one a block, in order of number
  double offset_s_ = 0;          ///< of the lower edge in (number, late_s)
  double slope_ = 0;
  bool started_ = false;

  int late_reads_ = 0;
  double late_since_s_ = 0;
  double late_least_s_ = 0;
  std::uint64_t ticks_missed_ = 0;
};

}  // namespace gyrocal::inemo
