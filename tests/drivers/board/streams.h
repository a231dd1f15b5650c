#pragma once

#include <cmath>
#include <random>
#include <variant>
#include <vector>

#include "drivers/board/parser.h"

/// Byte streams as a board sends them, for the tests of what reads them.
namespace gyrocal::inemo::test {

inline OutputMode raw_mode(bool temperature = true, bool all = false) {
  OutputMode mode;
  mode.raw = mode.gyro = true;
  mode.temperature = temperature || all;
  mode.accelerometer = mode.magnetometer = mode.pressure = all;
  return mode;
}

inline DataFrame random_frame(std::uint16_t counter, const OutputMode& mode, std::mt19937& random) {
  const auto around = [&random](double mean, double sigma) {
    return static_cast<std::int16_t>(std::lround(std::normal_distribution(mean, sigma)(random)));
  };
  DataFrame frame;
  frame.counter = counter;
  for (auto& axis : frame.gyro) axis = around(17, 5.4);
  if (mode.temperature) frame.temperature = static_cast<std::int16_t>(around(50, 30) * 128);
  if (mode.accelerometer) frame.accelerometer = {around(0, 20), around(0, 20), around(1000, 20)};
  if (mode.magnetometer) frame.magnetometer = {around(200, 9), around(-90, 9), around(400, 9)};
  if (mode.pressure) frame.pressure = static_cast<std::uint16_t>(around(16208, 4));
  return frame;
}

inline std::vector<DataFrame> random_frames(int count, std::uint16_t first, const OutputMode& mode,
                                            std::mt19937& random) {
  std::vector<DataFrame> frames;
  for (int i = 0; i < count; ++i) {
    frames.push_back(random_frame(static_cast<std::uint16_t>(first + i), mode, random));
  }
  return frames;
}

inline Bytes bytes_of(const std::vector<DataFrame>& frames, const OutputMode& mode) {
  Bytes bytes;
  for (const auto& frame : frames) encode_data_frame(layout_of(mode), frame, bytes);
  return bytes;
}

inline Bytes operator+(Bytes left, const Bytes& right) {
  left.insert(left.end(), right.begin(), right.end());
  return left;
}

inline std::vector<DataFrame> frames_in(const std::vector<Event>& events) {
  std::vector<DataFrame> frames;
  for (const auto& event : events) {
    if (const auto* data = std::get_if<DataEvent>(&event)) frames.push_back(data->frame);
  }
  return frames;
}

inline std::vector<ReplyEvent> replies_in(const std::vector<Event>& events) {
  std::vector<ReplyEvent> replies;
  for (const auto& event : events) {
    if (const auto* reply = std::get_if<ReplyEvent>(&event)) replies.push_back(*reply);
  }
  return replies;
}

/// A parser that streams: the mode is set and Start is acknowledged.
class Streaming {
 public:
  explicit Streaming(const OutputMode& mode) {
    parser.expect(mode);
    feed(encode_ack(Id::start));
    wait(1.0);
    events.clear();
  }
  void feed(std::span<const std::uint8_t> bytes) { parser.feed(bytes, now, events); }
  void wait(double s) {
    now += seconds(s);
    parser.feed({}, now, events);
  }

  Parser parser;
  Instant now{};
  std::vector<Event> events;
};

}  // namespace gyrocal::inemo::test
