#include "drivers/chamber/modbus_chamber.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <deque>
#include <map>

#include "config/campaign.h"
#include "drivers/clocks.h"
#include "drivers/recording/faulty_link.h"
#include "drivers/simulated/in_process_links.h"
#include "drivers/simulated/simulated_rig.h"

using namespace gyrocal;

namespace {

ChamberProfile profile_of(const std::string& name) {
  const auto profile =
      read_chamber_profile(std::string(GYROCAL_SOURCE_DIR) + "/config/chambers/" + name + ".toml");
  INFO((profile ? "" : to_text(profile.error())));
  REQUIRE(profile);
  return *profile;
}

struct Bench {
  explicit Bench(const ChamberProfile& profile)
      : rig(rig::RigModel{}, 7, 0, profile, 1),
        link(rig.chamber(), clock, seconds(1)),
        chamber(link, clock, profile, 1) {}

  VirtualClock clock;
  SimulatedRig rig;
  InProcessChamberLink link;
  ModbusChamber chamber;
};

/// Registers that do what a test says, for controllers that misbehave.
class OddController final : public RequestLink {
 public:
  Result<Bytes> transact(std::span<const std::uint8_t> bytes) override {
    const auto request = modbus::decode_request(bytes);
    REQUIRE(request);
    requests.push_back(*request);
    if (!exceptions.empty()) {
      const auto exception = exceptions.front();
      exceptions.pop_front();
      return modbus::encode_exception(request->unit, request->function, exception);
    }
    modbus::Words words;
    for (int i = 0; i < request->count; ++i) {
      std::uint16_t& word = registers[static_cast<std::uint16_t>(request->address + i)];
      if (modbus::is_write(*request) && takes_writes) {
        word = request->values[static_cast<std::size_t>(i)];
      }
      words.push_back(word);
    }
    return modbus::is_write(*request) ? modbus::encode_write_reply(*request)
                                      : modbus::encode_read_reply(*request, words);
  }

  std::map<std::uint16_t, std::uint16_t> registers;
  std::deque<modbus::Exception> exceptions;
  bool takes_writes = true;
  std::vector<modbus::Request> requests;
};

struct OddBench {
  VirtualClock clock;
  OddController link;
  ModbusChamber chamber{link, clock, profile_of("yinhe"), 1};
};

}  // namespace

TEST_CASE("every shipped profile drives a chamber that speaks it", "[chamber]") {
  const std::string name = GENERATE("yinhe", "watlow_f4t", "rtu_hundredths");
  CAPTURE(name);
  Bench bench(profile_of(name));
  const auto before = bench.chamber.read();
  REQUIRE(before);
  CHECK(before->run == ChamberRun::stopped);
  REQUIRE(bench.chamber.set_setpoint(Celsius{-10.25}));
  REQUIRE(bench.chamber.run());
  bench.clock.sleep_until(bench.clock.now() + seconds(3 * 3600));
  const auto after = bench.chamber.read();
  REQUIRE(after);
  CHECK(after->setpoint.value == Approx(-10.25));
  CHECK(std::abs(after->actual.value + 10.25) < 0.2);
  CHECK(after->run == ChamberRun::running);
  CHECK(after->constant_mode == (name == "yinhe" ? std::optional(true) : std::nullopt));
  REQUIRE(bench.chamber.stop());
  CHECK(bench.chamber.read()->run == ChamberRun::stopped);
}

TEST_CASE("a setpoint outside the limits, or none, is never sent", "[chamber]") {
  OddBench bench;
  CHECK(bench.chamber.set_setpoint(Celsius{90.01}).error().code == Errc::out_of_range);
  CHECK(bench.chamber.set_setpoint(Celsius{-60.01}).error().what ==
        "setpoint -60.01 degC, chamber Yinhe KHL-SDJ6025F goes from -60 to 90");
  CHECK(bench.chamber.set_setpoint(Celsius{std::nan("")}).error().code == Errc::not_finite);
  CHECK(bench.link.requests.empty());
}

TEST_CASE("a setpoint that somebody else holds is a mismatch after three tries", "[chamber]") {
  OddBench bench;
  bench.link.takes_writes = false;
  bench.link.registers[1742] = 0x41A0;  // 20.0
  const auto moved = bench.chamber.set_setpoint(Celsius{-10});
  REQUIRE_FALSE(moved);
  CHECK(moved.error().code == Errc::mismatch);
  CHECK(moved.error().what == "setpoint 1742: wrote -10 3 times, read 20");
  CHECK(bench.link.requests.size() == 6);
  CHECK(to_seconds(bench.clock.now() - Instant{}) == Approx(0.6));  // settled after each write
}

TEST_CASE("a busy controller is asked again, one that refuses is not", "[chamber]") {
  OddBench bench;
  bench.link.exceptions = {modbus::Exception::busy, modbus::Exception::acknowledge};
  CHECK(bench.chamber.set_setpoint(Celsius{25}));
  bench.link.exceptions = {modbus::Exception::busy, modbus::Exception::busy,
                           modbus::Exception::busy};
  bench.link.requests.clear();
  CHECK(bench.chamber.read().error().code == Errc::refused);
  CHECK(bench.link.requests.size() == 3);
  bench.link.exceptions = {modbus::Exception::illegal_address};
  bench.link.requests.clear();
  const auto reading = bench.chamber.read();
  REQUIRE_FALSE(reading);
  CHECK(reading.error().code == Errc::refused);
  CHECK(reading.error().what == "read 2 registers at 160: exception 2, illegal address");
  CHECK(bench.link.requests.size() == 1);
}

TEST_CASE("implausible readings are passed on, impossible ones are not", "[chamber]") {
  OddBench bench;
  CHECK(bench.chamber.read()->actual == Celsius{0.0});
  bench.link.registers[160] = 0x7FC0;
  CHECK(bench.chamber.read().error().code == Errc::not_finite);
}

TEST_CASE("a run state the profile does not know is named, not guessed", "[chamber]") {
  OddBench bench;
  bench.link.registers[200] = 7;
  const auto reading = bench.chamber.read();
  REQUIRE_FALSE(reading);
  CHECK(reading.error().code == Errc::bad_frame);
  CHECK(reading.error().what ==
        "run state register 200 holds 7, known are 0 stopped, 1 running, 2 paused");
}

TEST_CASE("a running program shows as not constant", "[chamber]") {
  OddBench bench;
  bench.link.registers[202] = 1;
  CHECK(bench.chamber.read()->constant_mode == false);
}

TEST_CASE("a chamber that runs already is not switched again", "[chamber]") {
  OddBench bench;
  REQUIRE(bench.chamber.run());
  CHECK(bench.link.registers[200] == 1);
  bench.link.requests.clear();
  REQUIRE(bench.chamber.run());
  for (const auto& request : bench.link.requests) CHECK_FALSE(modbus::is_write(request));
}

TEST_CASE("a chamber that does not start is a mismatch", "[chamber]") {
  OddBench bench;
  bench.link.takes_writes = false;
  const auto running = bench.chamber.run();
  REQUIRE_FALSE(running);
  CHECK(running.error().code == Errc::mismatch);
  CHECK(running.error().what == "running: wrote 1 to register 200 3 times, register 200 reads 0");
}

TEST_CASE("whichever call fails, a move is never reported done", "[chamber][fault]") {
  const auto loses = GENERATE(Fault::Loses::request, Fault::Loses::reply);
  const auto lasts = GENERATE(Fault::Lasts::once, Fault::Lasts::for_good);
  std::size_t n = 0;
  for (;; ++n) {
    CAPTURE(n);
    Bench bench(profile_of("yinhe"));
    FaultyRequestLink faulty(bench.link, {n, Errc::timeout, lasts, loses});
    ModbusChamber chamber(faulty, bench.clock, profile_of("yinhe"), 1);
    const auto moved = chamber.set_setpoint(Celsius{50});
    const auto running = moved ? chamber.run() : moved;
    if (!faulty.fired()) {
      CHECK(running);
      break;  // every call had its turn
    }
    CHECK_FALSE(running);
    CHECK(running.error().code == Errc::timeout);
  }
  CHECK(n == 6);  // setpoint written and read back; type seen; state seen, written, seen
}
