#include "daemon/runner/slow_stream.h"

#include <utility>

namespace gyrocal::runner {

double SlowInterval::gyro_mean_lsb(std::size_t axis) const {
  return frames > 0 ? double(gyro_sum_lsb[axis]) / double(frames) : missing;
}

double SlowInterval::board_c() const {
  return temperatures > 0 ? double(temperature_sum_raw) / double(temperatures) / 256.0 : missing;
}

SlowStream::SlowStream(Duration interval, Duration begin) : interval_(interval) {
  current_.begin = interval * (begin / interval);
}

void SlowStream::add(std::span<const BoardSample> samples) {
  for (const BoardSample& sample : samples) {
    while (sample.t_ns >= (current_.begin + interval_).count()) close();
    ++current_.frames;
    for (std::size_t axis = 0; axis < 3; ++axis)
      current_.gyro_sum_lsb[axis] += sample.gyro_lsb[axis];
    if (sample.temperature_raw) {
      current_.temperature_sum_raw += *sample.temperature_raw;
      ++current_.temperatures;
    }
    if (last_counter_ && sample.counter > *last_counter_) {
      current_.frames_missing += sample.counter - *last_counter_ - 1;
    }
    last_counter_ = sample.counter;
  }
}

void SlowStream::close_before(Duration t) {
  while (current_.begin + interval_ <= t) close();
}

std::vector<SlowInterval> SlowStream::take() { return std::exchange(closed_, {}); }

void SlowStream::close() {
  closed_.push_back(current_);
  current_ = SlowInterval{.begin = current_.begin + interval_};
}

}  // namespace gyrocal::runner
