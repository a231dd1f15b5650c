#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <functional>
#include <set>
#include <string>

#include "tests/drivers/board/streams.h"

/// What corruption of the byte stream costs, held to the figures drivers/board/parser.h promises.

using namespace gyrocal;
using namespace gyrocal::inemo;
using namespace gyrocal::inemo::test;

namespace {

constexpr int frames_per_stream = 24;
constexpr int corruptions = 4000;

struct Corrupted {
  Bytes bytes;
  std::set<int> touched;  ///< indices of frames that are no longer whole
};

using Corruption = std::function<Corrupted(Bytes, int frame_bytes, std::mt19937&)>;

int below(int limit, std::mt19937& random) {
  return std::uniform_int_distribution(0, limit - 1)(random);
}

Corrupted drop_bytes(Bytes bytes, int frame_bytes, std::mt19937& random) {
  const int count = 1 + below(10, random);  // a whole frame's length would leave no trace
  const int at = below(static_cast<int>(bytes.size()) - count, random);
  Corrupted result;
  for (int i = at; i < at + count; ++i) result.touched.insert(i / frame_bytes);
  bytes.erase(bytes.begin() + at, bytes.begin() + at + count);
  result.bytes = std::move(bytes);
  return result;
}

Corrupted insert(Bytes bytes, int frame_bytes, const Bytes& junk, std::mt19937& random) {
  const int at = below(static_cast<int>(bytes.size()), random);
  Corrupted result;
  if (at % frame_bytes != 0) result.touched.insert(at / frame_bytes);
  bytes.insert(bytes.begin() + at, junk.begin(), junk.end());
  result.bytes = std::move(bytes);
  return result;
}

Corrupted insert_noise(Bytes bytes, int frame_bytes, std::mt19937& random) {
  Bytes junk(static_cast<std::size_t>(1 + below(20, random)));
  for (auto& byte : junk) byte = static_cast<std::uint8_t>(random());
  return insert(std::move(bytes), frame_bytes, junk, random);
}

Corrupted insert_modem_command(Bytes bytes, int frame_bytes, std::mt19937& random) {
  const std::string at_command = "AT+GCAP\r\n";
  return insert(std::move(bytes), frame_bytes, Bytes(at_command.begin(), at_command.end()), random);
}

Corrupted double_frame(Bytes bytes, int frame_bytes, std::mt19937& random) {
  const int at = below(frames_per_stream, random) * frame_bytes;
  const Bytes frame(bytes.begin() + at, bytes.begin() + at + frame_bytes);
  bytes.insert(bytes.begin() + at, frame.begin(), frame.end());
  return {std::move(bytes), {}};
}

Corrupted overwrite(Bytes bytes, int frame_bytes, std::mt19937& random) {
  const int count = 1 + below(4, random);
  const int first = below(static_cast<int>(bytes.size()) - count, random);
  Corrupted result;
  for (int at = first; at < first + count; ++at) {
    bytes[static_cast<std::size_t>(at)] ^= static_cast<std::uint8_t>(1 + below(255, random));
    result.touched.insert(at / frame_bytes);
  }
  result.bytes = std::move(bytes);
  return result;
}

struct Cost {
  double good_lost = 0;   ///< whole frames that did not come out, per corruption
  double bad_passed = 0;  ///< frames that came out and were never sent, per corruption
};

Cost cost_of(const Corruption& corrupt, const OutputMode& mode, unsigned seed) {
  std::mt19937 random(seed);
  int lost = 0;
  int bad = 0;
  for (int run = 0; run < corruptions; ++run) {
    const auto frames = random_frames(frames_per_stream, 1, mode, random);
    const Corrupted stream = corrupt(bytes_of(frames, mode), layout_of(mode).frame_bytes, random);
    Streaming board(mode);
    board.feed(stream.bytes);
    for (int i = 0; i < 100; ++i) board.wait(1.1);
    const auto out = frames_in(board.events);
    for (int i = 0; i < frames_per_stream; ++i) {
      const bool whole = !stream.touched.contains(i);
      const auto& sent = frames[static_cast<std::size_t>(i)];
      if (whole && std::find(out.begin(), out.end(), sent) == out.end()) ++lost;
    }
    for (const auto& frame : out) {
      if (std::find(frames.begin(), frames.end(), frame) == frames.end()) ++bad;
    }
    CHECK(out.size() <= frames.size());
  }
  return {static_cast<double>(lost) / corruptions, static_cast<double>(bad) / corruptions};
}

}  // namespace

TEST_CASE("corrupted streams lose few good frames and pass hardly a false one",
          "[parser][property]") {
  const auto seed = GENERATE(1u, 2u);
  const OutputMode mode = GENERATE(raw_mode(false), raw_mode(true), raw_mode(true, true));
  const int frame_bytes = layout_of(mode).frame_bytes;
  const auto costs = [&](const Corruption& corrupt) {
    const Cost cost = cost_of(corrupt, mode, seed);
    UNSCOPED_INFO(fmt::format("seed {}, {}-byte frames: per corruption {} good lost, {} bad passed",
                              seed, frame_bytes, cost.good_lost, cost.bad_passed));
    return cost;
  };
  SECTION("bytes dropped") {
    const Cost cost = costs(drop_bytes);
    CHECK(cost.good_lost <= 0.4);
    CHECK(cost.bad_passed <= 0.002);
  }
  SECTION("noise inserted") {
    const Cost cost = costs(insert_noise);
    CHECK(cost.good_lost <= 0.4);
    CHECK(cost.bad_passed <= 0.002);
  }
  SECTION("a modem manager's command inserted") {
    const Cost cost = costs(insert_modem_command);
    CHECK(cost.good_lost <= 0.4);
    CHECK(cost.bad_passed <= 0.002);
  }
  SECTION("a frame doubled") {
    const Cost cost = costs(double_frame);
    CHECK(cost.good_lost == 0);
    CHECK(cost.bad_passed == 0);
  }
  SECTION("one to four bytes overwritten") {
    const Cost cost = costs(overwrite);
    CHECK(cost.good_lost <= 0.4);
    CHECK(cost.bad_passed <= 0.6);  // nothing tells a false payload from a true one
  }
}
