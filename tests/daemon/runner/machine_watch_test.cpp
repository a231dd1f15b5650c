#include "daemon/runner/machine_watch.h"

#include <catch2/catch.hpp>

namespace gyrocal::runner {
namespace {

constexpr std::uintmax_t plenty = 1'000'000'000;
constexpr std::int64_t s = 1'000'000'000;

}  // namespace

SCENARIO("clocks that agree, at any time scale, are nothing to tell") {
  MachineWatch watch(400);
  for (int i = 0; i < 100; ++i) CHECK(watch.look(seconds(400 * i), 77 * s + i * s, plenty).empty());
}

SCENARIO("UTC set back is told; UTC ahead may be a machine that slept") {
  MachineWatch watch(1);
  CHECK(watch.look(seconds(0), 1000 * s, plenty).empty());
  const auto back = watch.look(seconds(60), 900 * s, plenty);
  REQUIRE(back.size() == 1);
  CHECK(back[0].text.starts_with("UTC was set back by 160 s"));
  CHECK_FALSE(back[0].slept);
  const auto ahead = watch.look(seconds(120), 4560 * s, plenty);
  REQUIRE(ahead.size() == 1);
  CHECK(ahead[0].slept);
}

SCENARIO("a disk that fills up is told twice: when little is left, and when too little is") {
  MachineWatch watch(1);
  CHECK(watch.look(seconds(0), 0, 100'000'000).empty());
  REQUIRE(watch.look(seconds(1), s, 99'000'000).size() == 1);
  CHECK(watch.look(seconds(2), 2 * s, 98'000'000).empty());
  const auto full = watch.look(seconds(3), 3 * s, 19'000'000);
  REQUIRE(full.size() == 1);
  CHECK(full[0].disk_full);
  CHECK(watch.look(seconds(4), 4 * s, 18'000'000).empty());
  CHECK(watch.look(seconds(5), 5 * s, plenty).empty());
  CHECK(watch.look(seconds(6), 6 * s, 99'000'000).size() == 1);
}

}  // namespace gyrocal::runner
