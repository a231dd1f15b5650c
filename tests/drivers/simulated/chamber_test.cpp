#include <catch2/catch.hpp>

#include "drivers/chamber/register_value.h"
#include "drivers/clocks.h"
#include "drivers/simulated/in_process_links.h"
#include "tests/drivers/simulated/bench_board.h"

using namespace gyrocal;

namespace {

struct BenchChamber {
  explicit BenchChamber(const ChamberProfile& profile = yinhe_profile(), int unit = 1)
      : rig({}, 1, 0, profile, unit), chamber(rig.chamber()) {}
  std::string ask(const std::string& request, double t_s = 0) {
    const auto reply = chamber.answer(bytes(request), at_s(t_s));
    return reply ? hex(*reply) : "silence";
  }
  SimulatedRig rig;
  SimulatedChamber& chamber;
};

}  // namespace

TEST_CASE("the Yinhe map answers as the fact sheet's frames say", "[simulated][chamber]") {
  BenchChamber chamber;
  SECTION("actual temperature, 23 degC at rest") {
    CHECK(chamber.ask("01 03 00 a0 00 02") == "01 03 04 41 b8 00 00");
  }
  SECTION("setpoint: 22 degC is 41b0 0000") {
    CHECK(chamber.ask("01 10 06 ce 00 02 04 41 b0 00 00") == "01 10 06 ce 00 02");
    CHECK(chamber.ask("01 03 06 ce 00 02") == "01 03 04 41 b0 00 00");
  }
  SECTION("run, pause and stop are one register, written and read") {
    CHECK(chamber.ask("01 03 00 c8 00 01") == "01 03 02 00 00");
    CHECK(chamber.ask("01 10 00 c8 00 01 02 00 01") == "01 10 00 c8 00 01");
    CHECK(chamber.ask("01 03 00 c8 00 01") == "01 03 02 00 01");
    CHECK(chamber.ask("01 10 00 c8 00 01 02 00 02") == "01 10 00 c8 00 01");
    CHECK(chamber.ask("01 03 00 c8 00 01") == "01 03 02 00 02");
  }
  SECTION("run type: constant") {
    CHECK(chamber.ask("01 03 00 ca 00 01") == "01 03 02 00 00");
    CHECK(chamber.ask("01 10 00 ca 00 01 02 00 01") == "01 10 00 ca 00 01");
    CHECK(chamber.ask("01 03 00 ca 00 01") == "01 03 02 00 01");
  }
}

TEST_CASE("what the map has not is an exception, and nothing changes", "[simulated][chamber]") {
  BenchChamber chamber;
  SECTION("1: a function that is none of the four") {
    CHECK(chamber.ask("01 01 00 a0 00 02") == "01 81 01");
    CHECK(chamber.ask("01 07") == "01 87 01");
    CHECK(chamber.ask("01 2b 0e 01 00") == "01 ab 01");
  }
  SECTION("2: no register there, or not under this function") {
    CHECK(chamber.ask("01 03 00 00 00 01") == "01 83 02");
    CHECK(chamber.ask("01 03 00 a0 00 03") == "01 83 02");
    CHECK(chamber.ask("01 04 00 a0 00 02") == "01 84 02");
    CHECK(chamber.ask("01 06 06 ce 41 b0") == "01 86 02");
  }
  SECTION("2: half a float, or a measured value, cannot be written") {
    CHECK(chamber.ask("01 10 06 ce 00 01 02 41 b0") == "01 90 02");
    CHECK(chamber.ask("01 10 06 cf 00 01 02 41 b0") == "01 90 02");
    CHECK(chamber.ask("01 10 00 a0 00 02 04 41 b0 00 00") == "01 90 02");
  }
  SECTION("3: setpoints outside -60..90 degC and what is no number") {
    CHECK(chamber.ask("01 10 06 ce 00 02 04 42 b4 80 00") == "01 90 03");  // 90.25
    CHECK(chamber.ask("01 10 06 ce 00 02 04 c2 70 80 00") == "01 90 03");  // -60.125
    CHECK(chamber.ask("01 10 06 ce 00 02 04 7f c0 00 00") == "01 90 03");  // NaN
    CHECK(chamber.ask("01 10 06 ce 00 02 04 7f 80 00 00") == "01 90 03");  // infinity
  }
  SECTION("3: an unknown state, a count of 0, 126 or not that of the bytes") {
    CHECK(chamber.ask("01 10 00 c8 00 01 02 00 07") == "01 90 03");
    CHECK(chamber.ask("01 03 00 a0 00 00") == "01 83 03");
    CHECK(chamber.ask("01 03 00 a0 00 7e") == "01 83 03");
    CHECK(chamber.ask("01 10 06 ce 00 02 02 41 b0") == "01 90 03");
  }
  CHECK(chamber.chamber.setpoint() == Celsius{25});
  CHECK(chamber.chamber.run() == ChamberRun::stopped);
}

TEST_CASE("requests for another unit are not answered and not obeyed", "[simulated][chamber]") {
  BenchChamber chamber(yinhe_profile(), 2);
  CHECK(chamber.ask("01 10 06 ce 00 02 04 41 b0 00 00") == "silence");
  CHECK(chamber.ask("00 03 00 a0 00 02") == "silence");
  CHECK(chamber.chamber.setpoint() == Celsius{25});
  CHECK(chamber.ask("02 03 00 a0 00 02") == "02 03 04 41 b8 00 00");
}

TEST_CASE("another map: hundredths in int16, function 6, command and state apart",
          "[simulated][chamber]") {
  BenchChamber chamber(hundredths_profile());
  CHECK(chamber.ask("01 06 00 66 fc 18") == "01 06 00 66 fc 18");  // -10.00
  CHECK(chamber.chamber.setpoint() == Celsius{-10});
  CHECK(chamber.ask("01 03 00 66 00 01") == "01 03 02 fc 18");
  CHECK(chamber.ask("01 03 00 01 00 01") == "01 03 02 08 fc");  // 23.00
  CHECK(chamber.ask("01 06 00 65 00 01") == "01 06 00 65 00 01");
  CHECK(chamber.ask("01 03 00 0a 00 01") == "01 03 02 00 01");
  CHECK(chamber.ask("01 06 00 65 00 04") == "01 06 00 65 00 04");
  CHECK(chamber.ask("01 03 00 0a 00 01") == "01 03 02 00 00");
  CHECK(chamber.ask("01 06 00 0a 00 01") == "01 86 02");
  CHECK(chamber.ask("01 06 00 66 e8 8f") == "01 86 03");  // -60.01
}

TEST_CASE("the air follows the setpoint only while the chamber runs in constant mode",
          "[simulated][chamber]") {
  BenchChamber chamber;
  chamber.ask("01 10 06 ce 00 02 04 42 20 00 00", 0);  // 40 degC
  CHECK(chamber.chamber.actual(at_s(3600)).value == Approx(23.0));
  chamber.ask("01 10 00 c8 00 01 02 00 01", 3600);
  CHECK(chamber.chamber.actual(at_s(3600 + 600)).value == Approx(33.0).margin(0.2));
  SECTION("and stays there") {
    CHECK(chamber.chamber.actual(at_s(3 * 3600)).value == Approx(40.0).margin(0.16));
  }
  SECTION("paused it holds what it has") {
    chamber.ask("01 10 00 c8 00 01 02 00 02", 4200);
    CHECK(chamber.chamber.actual(at_s(3 * 3600)).value == Approx(33.0).margin(0.4));
  }
  SECTION("stopped it drifts to ambient") {
    chamber.ask("01 10 00 c8 00 01 02 00 00", 4200);
    CHECK(chamber.chamber.actual(at_s(24 * 3600)).value == Approx(23.0).margin(0.01));
  }
  SECTION("in program mode a setpoint moves nothing") {
    chamber.ask("01 10 00 ca 00 01 02 00 01", 4200);
    chamber.ask("01 10 06 ce 00 02 04 41 b0 00 00", 4200);
    CHECK(chamber.chamber.actual(at_s(3 * 3600)).value == Approx(33.0).margin(0.4));
  }
}

TEST_CASE("a hand on the panel is seen on the wire", "[simulated][chamber]") {
  BenchChamber chamber;
  chamber.chamber.set_at_panel(Celsius{22}, at_s(5));
  chamber.chamber.set_at_panel(ChamberRun::running, at_s(6));
  CHECK(chamber.ask("01 03 06 ce 00 02", 7) == "01 03 04 41 b0 00 00");
  CHECK(chamber.ask("01 03 00 c8 00 01", 7) == "01 03 02 00 01");
}

TEST_CASE("in process, silence lasts the reply time-out of the clock", "[simulated][chamber]") {
  BenchChamber bench;
  VirtualClock clock;
  InProcessChamberLink link(bench.chamber, clock, seconds(1));
  const auto reply = link.transact(bytes("01 03 00 a0 00 02"));
  REQUIRE(reply.has_value());
  CHECK(hex(*reply) == "01 03 04 41 b8 00 00");
  CHECK(clock.now() == at_s(0));
  const auto silence = link.transact(bytes("09 03 00 a0 00 02"));
  REQUIRE_FALSE(silence.has_value());
  CHECK(silence.error().code == Errc::timeout);
  CHECK(clock.now() == at_s(1));
}
