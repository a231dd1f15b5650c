#include <sys/eventfd.h>

#include <catch2/catch.hpp>
#include <thread>

#include "drivers/board/inemo_board.h"
#include "drivers/board/serial_link.h"
#include "drivers/chamber/modbus_chamber.h"
#include "drivers/chamber/modbus_link.h"
#include "drivers/clocks.h"
#include "drivers/simulated/rig_server.h"
#include "tests/drivers/recording/temporary_directory.h"

/// Both drivers against a rig on real endpoints: libmodbus talks to libmodbus over TCP, and the
/// board's bytes pass a pseudo-terminal.

using namespace gyrocal;

namespace {

constexpr double time_scale = 50;

ChamberProfile profile() {
  return *read_chamber_profile(std::string(GYROCAL_SOURCE_DIR) + "/config/chambers/yinhe.toml");
}

/// A rig that is served on a thread of its own.
class ServedRig {
 public:
  ServedRig() {
    auto opened = RigServer::open(rig_, clock_, {"127.0.0.1", 0, {link}}, time_scale);
    INFO((opened ? "" : to_text(opened.error())));
    REQUIRE(opened);
    port = opened->port();
    thread_ = std::thread([this, server = std::move(*opened)]() mutable {
      served_ = server.run(stop_.get()).has_value();
    });
  }
  ~ServedRig() {
    eventfd_write(stop_.get(), 1);
    thread_.join();
    CHECK(served_);
  }
  ServedRig(const ServedRig&) = delete;
  ServedRig& operator=(const ServedRig&) = delete;

  gyrocal::test::TemporaryDirectory directory;
  std::string link = directory.file("board0");
  int port = 0;

 private:
  ScaledClock clock_{time_scale};
  SimulatedRig rig_{rig::RigModel{}, 7, 1, profile(), 1};
  UniqueFd stop_{eventfd(0, EFD_CLOEXEC)};
  bool served_ = false;
  std::thread thread_;
};

/// Drains until `count` samples have come, for ten minutes of the rig's time at most.
std::vector<BoardSample> samples_of(InemoBoard& board, Clock& clock, std::size_t count) {
  std::vector<BoardSample> samples;
  const Instant deadline = clock.now() + seconds(600);
  while (samples.size() < count && clock.now() < deadline) {
    REQUIRE(board.drain(samples));
    clock.sleep_until(clock.now() + seconds(0.5));
  }
  return samples;
}

}  // namespace

TEST_CASE("a board on a port streams without loss, and again after it is opened anew",
          "[endpoints]") {
  ServedRig rig;
  ScaledClock clock(time_scale);
  SerialLink link(rig.link);
  InemoBoard board(link, clock, BoardTiming::for_time_scale(time_scale));
  for (int i = 0; i < 2; ++i) {
    const auto identity = board.open({});
    INFO((identity ? "" : to_text(identity.error())));
    REQUIRE(identity);
    CHECK(identity->firmware_version == "iNEMO Firmware_Version_2.2");
    REQUIRE(board.start());
    const auto samples = samples_of(board, clock, 1000);
    REQUIRE(samples.size() >= 1000);
    for (std::size_t n = 0; n < samples.size(); ++n) CHECK(samples[n].counter == n + 1);
    CHECK(board.tally().bytes_skipped == 0);
    CHECK(board.tally().missing == 0);
    REQUIRE(link.reopen());  // while it streams: its first frame afterwards is stale
  }
}

TEST_CASE("a chamber on a socket takes a setpoint and goes there", "[endpoints]") {
  ServedRig rig;
  ScaledClock clock(time_scale);
  ModbusLink link(TcpAddress{"127.0.0.1", rig.port}, seconds(5), clock);
  ModbusChamber chamber(link, clock, profile(), 1);
  REQUIRE(chamber.set_setpoint(Celsius{26}));
  REQUIRE(chamber.run());
  const auto reading = chamber.read();
  REQUIRE(reading);
  CHECK(reading->setpoint == Celsius{26});
  CHECK(reading->run == ChamberRun::running);
  CHECK(reading->constant_mode == true);
  REQUIRE(chamber.stop());
  CHECK(chamber.read()->run == ChamberRun::stopped);
}

TEST_CASE("a chamber of another unit number says nothing", "[endpoints]") {
  ServedRig rig;
  ScaledClock clock(time_scale);
  ModbusLink link(TcpAddress{"127.0.0.1", rig.port}, seconds(0.2), clock);
  ModbusChamber chamber(link, clock, profile(), 2);
  CHECK(chamber.read().error().code == Errc::timeout);
}
