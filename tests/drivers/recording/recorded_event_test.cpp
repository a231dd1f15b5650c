#include "drivers/recording/recorded_event.h"

#include <catch2/catch.hpp>
#include <limits>

#include "drivers/recording/compression.h"
#include "tests/drivers/recording/random_events.h"

using namespace gyrocal;

TEST_CASE("events survive packing", "[recording][property]") {
  const auto seed = GENERATE(range(0u, 20u));
  CAPTURE(seed);
  std::mt19937 random(seed);
  const auto events = test::random_events(seed * 7, random);
  CHECK(decode_events(encode_events(events)) == events);
}

TEST_CASE("times at both ends of what a clock can hold survive packing", "[recording]") {
  using Limits = std::numeric_limits<std::int64_t>;
  std::vector<RecordedEvent> events(3);
  events[0].begin = Instant{Duration{Limits::min()}};
  events[0].end = Instant{Duration{Limits::max()}};
  events[1].begin = Instant{Duration{Limits::max()}};
  events[1].end = Instant{Duration{Limits::min()}};
  events[2].begin = Instant{Duration{1'767'225'600'000'000'000}};
  CHECK(decode_events(encode_events(events)) == events);
}

TEST_CASE("whatever is cut off or added is noticed", "[recording]") {
  std::mt19937 random(5);
  const Bytes whole = encode_events(test::random_events(10, random));
  for (std::size_t size = 0; size < whole.size(); ++size) {
    CAPTURE(size);
    CHECK(decode_events(std::span(whole).first(size)).error().code == Errc::bad_frame);
  }
  Bytes longer = whole;
  longer.push_back(0);
  CHECK_FALSE(decode_events(longer));
}

TEST_CASE("one flipped bit of a compressed piece is noticed", "[recording]") {
  std::mt19937 random(6);
  const Bytes packed = compressed(encode_events(test::random_events(50, random)), 3);
  CHECK(decompressed(packed, 1 << 20).has_value());
  CHECK_FALSE(decompressed(packed, 10));
  for (std::size_t i = 8; i < packed.size(); i += 7) {
    CAPTURE(i);
    Bytes damaged = packed;
    damaged[i] ^= 0x10;
    CHECK_FALSE(decompressed(damaged, 1 << 20));
  }
}
