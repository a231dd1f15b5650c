#include "drivers/board/inemo_board.h"
#include "drivers/board/serial_link.h"
#include "drivers/chamber/modbus_chamber.h"
#include "drivers/chamber/modbus_link.h"
#include "drivers/simulated/in_process_links.h"
#include "tests/drivers/simulated/bench_board.h"
#include "tests/drivers/simulated/running_rig.h"

using namespace gyrocal;

namespace {

constexpr BoardMode mode{50, false, true};

/// The driver's whole acquaintance with a board and its first `wanted` samples.
std::vector<BoardSample> first_samples(InemoBoard& board, Clock& clock, std::size_t wanted) {
  const auto identity = board.open(mode);
  REQUIRE(identity.has_value());
  CHECK(identity->mcu_id == "30ffd8054752323751160000");
  CHECK(identity->firmware_version == "iNEMO Firmware_Version_2.2");
  CHECK(identity->hardware_version == "iNEMO V2 Hardware_Version_1");
  REQUIRE(board.start().has_value());
  std::vector<BoardSample> samples;
  while (samples.size() < wanted) {
    clock.sleep_until(clock.now() + seconds(0.5));
    REQUIRE(board.drain(samples).has_value());
  }
  REQUIRE(board.stop().has_value());
  CHECK(board.tally().missing == 0);
  CHECK(board.tally().bytes_skipped == 0);
  for (std::size_t i = 0; i < wanted; ++i) REQUIRE(samples[i].counter == i + 1);
  return samples;
}

void drive(ModbusChamber& chamber) {
  REQUIRE(chamber.set_setpoint(Celsius{-10}).has_value());
  REQUIRE(chamber.run().has_value());
  const auto reading = chamber.read();
  REQUIRE(reading.has_value());
  CHECK(reading->setpoint == Celsius{-10});
  CHECK(reading->run == ChamberRun::running);
  CHECK(reading->constant_mode == true);
  CHECK(reading->actual.value == Approx(23).margin(2));
  REQUIRE(chamber.stop().has_value());
}

}  // namespace

TEST_CASE("the drivers talk to the simulated devices in process", "[simulated][drivers]") {
  VirtualClock clock;
  SimulatedRig rig({}, 1, 1, yinhe_profile(), 1);
  InProcessChamberLink chamber_link(rig.chamber(), clock, seconds(1));
  ModbusChamber chamber(chamber_link, clock, yinhe_profile(), 1);
  drive(chamber);
  InProcessBoardLink board_link(rig.board(0), clock);
  InemoBoard board(board_link, clock);
  const auto samples = first_samples(board, clock, 3000);
  CHECK(samples.at(0).temperature_raw == 23 * 256);
}

TEST_CASE("the drivers talk to the simulated devices over TCP and a terminal",
          "[simulated][drivers]") {
  constexpr double time_scale = 100;
  RunningRig rig(1, time_scale);
  ScaledClock clock(time_scale);
  ModbusLink chamber_link(TcpAddress{"127.0.0.1", rig.port()}, seconds(5), clock);
  ModbusChamber chamber(chamber_link, clock, yinhe_profile(), 1);
  drive(chamber);
  SerialLink board_link(rig.link(0));
  InemoBoard board(board_link, clock, BoardTiming::for_time_scale(time_scale));
  first_samples(board, clock, 1000);
  first_samples(board, clock, 1000);  // taken over while it is connected and set
}

TEST_CASE("a setpoint the chamber refuses is an error, not a wait", "[simulated][drivers]") {
  VirtualClock clock;
  auto narrow = yinhe_profile();
  narrow.limit_min = Celsius{-20};
  SimulatedRig rig({}, 1, 0, narrow, 1);
  InProcessChamberLink link(rig.chamber(), clock, seconds(1));
  ModbusChamber chamber(link, clock, yinhe_profile(), 1);
  const auto refused = chamber.set_setpoint(Celsius{-30});
  REQUIRE_FALSE(refused.has_value());
  CHECK(refused.error().code == Errc::refused);
  CHECK(rig.chamber().setpoint() == Celsius{25});
}
