#include <catch2/catch.hpp>
#include <random>

#include "drivers/clocks.h"
#include "drivers/simulated/in_process_links.h"
#include "tests/drivers/simulated/bench_board.h"

using namespace gyrocal;

namespace {

Bytes read_all(ByteLink& link) {
  Bytes all;
  std::array<std::uint8_t, 4096> chunk;
  for (;;) {
    const auto count = link.read(chunk);
    REQUIRE(count.has_value());
    if (*count == 0) return all;
    all.insert(all.end(), chunk.begin(), chunk.begin() + static_cast<std::ptrdiff_t>(*count));
  }
}

void start_streaming(ByteLink& link) {
  for (const char* packet : {"20 01 00", "20 05 50 29 18 00 00", "20 01 52"}) {
    REQUIRE(link.write(bytes(packet)).has_value());
  }
}

/// An hour of two boards through a setpoint change, asked in one order or the other; all bytes.
std::array<Bytes, 2> an_hour(std::uint64_t seed, bool second_board_first, unsigned looks_seed) {
  VirtualClock clock;
  SimulatedRig rig({}, seed, 2, yinhe_profile(), 1);
  InProcessChamberLink chamber(rig.chamber(), clock, seconds(1));
  InProcessBoardLink links[]{{rig.board(0), clock}, {rig.board(1), clock}};
  std::array<Bytes, 2> heard;
  const auto listen = [&](std::size_t index) {
    const Bytes more = read_all(links[index]);
    heard[index].insert(heard[index].end(), more.begin(), more.end());
  };
  for (auto& link : links) start_streaming(link);
  std::mt19937 random(looks_seed);
  const auto run_until = [&](double until_s) {
    for (double t_s = to_seconds(clock.now().time_since_epoch()); t_s < until_s;) {
      t_s = std::min(until_s, t_s + 1 + static_cast<double>(random() % 100));
      clock.sleep_until(at_s(t_s));
      listen(second_board_first ? 1 : 0);
      if (random() % 3 != 0) listen(second_board_first ? 0 : 1);
      REQUIRE(chamber.transact(bytes("01 03 00 a0 00 02")).has_value());
    }
  };
  run_until(600.05);
  REQUIRE(chamber.transact(bytes("01 10 06 ce 00 02 04 c1 20 00 00")).has_value());  // -10 degC
  REQUIRE(chamber.transact(bytes("01 10 00 c8 00 01 02 00 01")).has_value());
  run_until(3600);
  for (const std::size_t index : {0U, 1U}) listen(index);
  return heard;
}

}  // namespace

TEST_CASE("the same seed gives the same bytes, whoever is asked first and how often",
          "[simulated][rig][property]") {
  const auto looks_seed = GENERATE(range(1U, 6U));
  CAPTURE(looks_seed);
  const auto reference = an_hour(7, false, 0);
  CHECK(reference[0].size() > 3599U * 50U * 13U);
  CHECK(an_hour(7, true, looks_seed) == reference);
  CHECK(an_hour(7, false, looks_seed) == reference);
}

TEST_CASE("another seed, or another board, gives other bytes", "[simulated][rig]") {
  const auto one = an_hour(7, false, 0);
  const auto other = an_hour(8, false, 0);
  CHECK(one[0] != other[0]);
  CHECK(one[0] != one[1]);
}

TEST_CASE("a link to an unplugged board is lost, and found again", "[simulated][rig]") {
  VirtualClock clock;
  SimulatedRig rig({}, 1, 1, yinhe_profile(), 1);
  InProcessBoardLink link(rig.board(0), clock);
  std::array<std::uint8_t, 64> into;
  CHECK(link.read(into).has_value());
  rig.board(0).unplug(clock.now());
  CHECK(link.read(into).error().code == Errc::link_lost);
  CHECK(link.write(bytes("20 01 00")).error().code == Errc::link_lost);
  CHECK(link.reopen().error().code == Errc::link_lost);
  rig.board(0).plug_in(clock.now());
  CHECK(link.read(into).error().code == Errc::link_lost);  // the old one is gone for good
  REQUIRE(link.reopen().has_value());
  REQUIRE(link.write(bytes("20 01 00")).has_value());
  CHECK(hex(read_all(link)) == "80 01 00");
}

TEST_CASE("reopening the port of a streaming board brings no bytes of before", "[simulated][rig]") {
  VirtualClock clock;
  SimulatedRig rig(still_model({1, 2, 3}), 1, 1, yinhe_profile(), 1);
  InProcessBoardLink link(rig.board(0), clock);
  start_streaming(link);
  clock.sleep_until(at_s(10));
  REQUIRE(link.reopen().has_value());
  clock.sleep_until(at_s(10.02));
  CHECK(hex(read_all(link)) == "40 0b 52 01 f5 00 01 00 02 00 03 17 00");
}
