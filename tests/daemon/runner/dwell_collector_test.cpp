#include "daemon/runner/dwell_collector.h"

#include <catch2/catch.hpp>
#include <cmath>

namespace gyrocal::runner {
namespace {

std::vector<BoardSample> frames(std::uint32_t first, int count, std::int64_t t_ns = 100) {
  std::vector<BoardSample> made;
  for (int i = 0; i < count; ++i) {
    made.push_back({t_ns + i, first + static_cast<std::uint32_t>(i), {0, 0, 17}, 5120});
  }
  return made;
}

const std::vector<std::size_t> both = {0, 1};

}  // namespace

SCENARIO("a dwell holds exactly the samples asked for, of every board, from its begin on") {
  DwellCollector collector(100, 0.01);
  collector.begin(Duration{100}, both);
  collector.add(0, frames(1, 10, 50));  // before it began
  collector.add(0, frames(11, 120));
  CHECK_FALSE(collector.full());
  CHECK(collector.progress() == 0);
  collector.add(1, frames(5, 60));
  CHECK(collector.progress() == 0.6);
  collector.add(1, frames(65, 40, 200));
  REQUIRE(collector.full());
  CHECK_FALSE(collector.shortfall());
  const auto group = collector.finish(std::nullopt);
  REQUIRE(group.size() == 2);
  CHECK(group[0].samples.size() == 100);
  CHECK(group[0].samples.front().counter == 11);
  CHECK(group[1].samples.size() == 100);
  CHECK(group[1].frames_missing == 0);
  CHECK(group[1].board_mean_c == 20);
  CHECK_FALSE(collector.running());
}

SCENARIO("one frame in a hundred may be lost, two not") {
  DwellCollector collector(99, 0.01);
  collector.begin(Duration{100}, both);
  collector.add(0, frames(1, 50));
  collector.add(0, frames(52, 49, 200));
  collector.add(1, frames(1, 50));
  collector.add(1, frames(53, 49, 200));
  REQUIRE(collector.full());
  REQUIRE(collector.shortfall());
  CHECK(collector.shortfall()->board == 1);
  const auto group = collector.finish(std::nullopt);
  CHECK(group[0].frames_missing == 1);
  CHECK_FALSE(group[0].reject_reason);
  CHECK(group[1].frames_missing == 2);
  CHECK(group[1].reject_reason == "2 of 101 frames missing");
}

SCENARIO("a board that starts anew spoils its dwell, not the other's") {
  DwellCollector collector(10, 0.01);
  collector.begin(Duration{100}, both);
  collector.add(0, frames(500, 5));
  collector.add(0, frames(1, 5));
  collector.add(1, frames(1, 10));
  REQUIRE(collector.full());
  const auto group = collector.finish(std::nullopt);
  CHECK(group[0].reject_reason == "the board started anew");
  CHECK(group[0].samples.size() == 5);
  CHECK_FALSE(group[1].reject_reason);
}

SCENARIO("a dwell broken off keeps what it has, marked") {
  DwellCollector collector(10, 0.01);
  collector.begin(Duration{100}, both);
  collector.add(0, frames(1, 4));
  const auto group = collector.finish("the door was opened");
  REQUIRE(group.size() == 2);
  CHECK(group[0].samples.size() == 4);
  CHECK(group[0].reject_reason == "the door was opened");
  CHECK(group[1].samples.empty());
  CHECK(std::isnan(group[1].board_mean_c));
}

SCENARIO("a board that has its samples is not spoilt by going away afterwards") {
  DwellCollector collector(10, 0.01);
  collector.begin(Duration{100}, both);
  collector.add(0, frames(1, 10));
  collector.spoil(0, "unplugged");
  collector.spoil(1, "unplugged");
  REQUIRE(collector.full());
  const auto group = collector.finish(std::nullopt);
  CHECK_FALSE(group[0].reject_reason);
  CHECK(group[1].reject_reason == "unplugged");
}

SCENARIO("a dwell is rejected for what happened between its own first and last sample") {
  DwellCollector collector(10, 0.01);
  collector.begin(Duration{100}, both);
  collector.add(0, frames(1, 10, 100));
  collector.add(1, frames(1, 10, 200));
  REQUIRE(collector.full());
  collector.look_back([](Duration from, Duration to) -> std::optional<std::string> {
    if (Duration{150} < from || to < Duration{105}) return std::nullopt;
    return "the lights went out";
  });
  REQUIRE(collector.shortfall());
  CHECK(collector.shortfall()->board == 0);
  const auto group = collector.finish(std::nullopt);
  CHECK(group[0].reject_reason == "the lights went out");
  CHECK(group[0].samples.size() == 10);
  CHECK_FALSE(group[1].reject_reason);
}

}  // namespace gyrocal::runner
