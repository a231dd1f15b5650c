#include <catch2/catch.hpp>
#include <random>

#include "drivers/big_endian.h"
#include "tests/drivers/simulated/bench_board.h"

using namespace gyrocal;

namespace {

struct Streaming : BenchBoard {
  Streaming(const rig::RigModel& model, const std::string& mode, std::size_t output_bytes_max)
      : BenchBoard(model, output_bytes_max) {
    say("20 01 00");
    REQUIRE(say("20 05 50 " + mode) == "80 01 50");
    REQUIRE(say("20 01 52") == "80 01 52");
  }
  explicit Streaming(const std::string& mode, std::size_t output_bytes_max = SIZE_MAX)
      : Streaming(still_model({17, -3, 5}), mode, output_bytes_max) {}
};

/// The counters of gyro frames (11 bytes each).
std::vector<int> counters(std::span<const std::uint8_t> frames) {
  std::vector<int> found;
  for (std::size_t at = 0; at + 11 <= frames.size(); at += 11) {
    found.push_back(get_u16(frames, at + 3));
  }
  return found;
}

}  // namespace

TEST_CASE("frames carry what the mode asks for, in the firmware's order", "[simulated][board]") {
  SECTION("gyro, raw") {
    Streaming board("28 18 00 00");
    CHECK(board.heard(0.019).empty());
    CHECK(board.heard(0.02) == "40 09 52 00 01 00 11 ff fd 00 05");
    CHECK(board.heard(0.04) == "40 09 52 00 02 00 11 ff fd 00 05");
  }
  SECTION("gyro and temperature, raw: 23 degC") {
    Streaming board("29 18 00 00");
    CHECK(board.heard(0.02) == "40 0b 52 00 01 00 11 ff fd 00 05 17 00");
  }
  SECTION("everything, raw: 27 bytes") {
    Streaming board("3f 18 00 00");
    CHECK(board.heard(0.02) ==
          "40 19 52 00 01 ff d0 00 10 3e 70 00 11 ff fd 00 05 00 d3 00 00 01 98 3f 54 17 00");
  }
  SECTION("everything, calibrated: mg, whole deg/s, mG, 0.1 mbar, 0.1 degC") {
    Streaming board("1f 18 00 00");
    CHECK(board.heard(0.02) ==
          "40 19 52 00 01 ff fd 00 01 03 e7 00 04 00 00 00 01 00 c8 00 00 01 82 27 94 00 e6");
  }
  SECTION("nothing but the counter") {
    Streaming board("20 18 00 00");
    CHECK(board.heard(0.02) == "40 03 52 00 01");
  }
}

TEST_CASE("the full scale changes calibrated frames only", "[simulated][board]") {
  BenchBoard board(still_model({100, 100, 100}));
  board.say("20 01 00");
  board.say("20 04 20 02 00 08");
  SECTION("calibrated: 100 counts are 97 deg/s of roll, 21 of yaw") {
    board.say("20 05 50 08 18 00 00");
    board.say("20 01 52");
    CHECK(board.heard(0.02) == "40 09 52 00 01 00 61 00 61 00 15");
  }
  SECTION("raw") {
    board.say("20 05 50 28 18 00 00");
    board.say("20 01 52");
    CHECK(board.heard(0.02) == "40 09 52 00 01 00 64 00 64 00 64");
  }
}

TEST_CASE("the calibrated temperature is broken below zero, as the firmware has it",
          "[simulated][board]") {
  auto model = still_model({0, 0, 0});
  model.baseline.chamber.ambient_c = -10;
  SECTION("calibrated: -10 degC arrives as 849c") {
    Streaming board(model, "01 18 00 00", SIZE_MAX);
    CHECK(board.heard(0.02) == "40 05 52 00 01 84 9c");
  }
  SECTION("raw: degC * 256") {
    Streaming board(model, "21 18 00 00", SIZE_MAX);
    CHECK(board.heard(0.02) == "40 05 52 00 01 f6 00");
  }
}

TEST_CASE("the seven rate codes are 1 10 25 50 30 100 400 Hz", "[simulated][board]") {
  constexpr int rates[] = {1, 10, 25, 50, 30, 100, 400};
  for (int code = 0; code < 7; ++code) {
    Streaming board(fmt::format("28 {:02x} 00 00", code << 3));
    board.board.advance(at_s(10));
    CHECK(board.board.output().size() == 11U * 10U * static_cast<unsigned>(rates[code]));
  }
}

TEST_CASE("a counted acquisition ends in silence", "[simulated][board]") {
  Streaming board("28 18 00 03");
  board.board.advance(at_s(10));
  CHECK(counters(board.board.output()) == std::vector<int>{1, 2, 3});
  CHECK_FALSE(board.board.streaming());
}

TEST_CASE("Stop is acknowledged after the last frame, and Start counts from 1 again",
          "[simulated][board]") {
  Streaming board("28 18 00 00");
  CHECK(board.say("20 01 53", 0.05) ==
        "40 09 52 00 01 00 11 ff fd 00 05 40 09 52 00 02 00 11 ff fd 00 05 80 01 53");
  CHECK(board.heard(1).empty());
  CHECK(board.say("20 01 52", 1) == "80 01 52");
  CHECK(board.heard(1.02) == "40 09 52 00 01 00 11 ff fd 00 05");
}

TEST_CASE("Start while streaming starts the counter again", "[simulated][board]") {
  Streaming board("28 18 00 00");
  board.say("20 01 52", 0.05);
  CHECK(board.heard(0.07) == "40 09 52 00 01 00 11 ff fd 00 05");
}

TEST_CASE("the counter wraps from 65535 to 0", "[simulated][board]") {
  Streaming board("28 30 00 00");
  board.board.advance(at_s(65534.0 / 400));
  board.board.take(board.board.output().size());
  board.board.advance(at_s(65538.0 / 400));
  CHECK(counters(board.board.output()) == std::vector<int>{65535, 0, 1, 2});
}

TEST_CASE("a host that takes nothing stops the sampling, without a gap in the counter",
          "[simulated][board]") {
  Streaming board("28 18 00 00", 30);
  board.board.advance(at_s(1));
  CHECK(counters(board.board.output()) == std::vector<int>{1, 2});
  board.board.take(22);  // the frame built at 0.06 s comes now, the next tick's after it
  board.board.advance(at_s(1.02));
  CHECK(counters(board.board.output()) == std::vector<int>{3, 4});
}

TEST_CASE("after a closed port the first frame is stale", "[simulated][board]") {
  auto model = still_model({17, -3, 5});
  model.baseline.noise_dps = 100;
  Streaming closed(model, "28 18 00 00", SIZE_MAX);
  Streaming watched(model, "28 18 00 00", SIZE_MAX);
  closed.board.host_closes(at_s(0.05));
  closed.board.host_opens(at_s(60));
  closed.board.advance(at_s(60.02));
  CHECK(counters(closed.board.output()) == std::vector<int>{3, 4});
  watched.board.advance(at_s(0.07));
  const std::string third = hex(watched.board.output().subspan(22, 11));
  CHECK(hex(closed.board.output().first(11)) == third);  // taken a minute ago
}

TEST_CASE("state lives in the board: it streams on for a host that comes back",
          "[simulated][board]") {
  Streaming board("28 18 00 00");
  board.board.host_closes(at_s(1));
  board.board.host_opens(at_s(2));
  CHECK(board.board.streaming());
  CHECK(board.say("20 01 13", 2).find("80 1b 13") != std::string::npos);
}

TEST_CASE("an unplugged board loses everything", "[simulated][board]") {
  Streaming board("28 18 00 00");
  board.board.unplug(at_s(1));
  CHECK(board.say("20 01 00", 2).empty());
  board.board.plug_in(at_s(3));
  CHECK(board.heard(10).empty());
  CHECK(board.say("20 01 51", 10) == "c0 02 51 05");
}

TEST_CASE("the temperature trap: read at 50 Hz the sensor stands still, at 1 Hz it does not",
          "[simulated][board]") {
  auto model = still_model({0, 0, 0});
  SimulatedRig rig(model, 1, 2, yinhe_profile(), 1);
  rig.chamber().set_at_panel(Celsius{50}, at_s(0));
  rig.chamber().set_at_panel(ChamberRun::running, at_s(0));
  const auto last_temperature = [&](std::size_t index, const char* mode) {
    SimulatedBoard& board = rig.board(index);
    board.set_temperature_trap(true);
    board.receive(bytes("20 01 00"), at_s(0));
    board.receive(bytes(mode), at_s(0));
    board.receive(bytes("20 01 52"), at_s(0));
    board.advance(at_s(7200));
    return get_s16(board.output(), board.output().size() - 2) / 256.0;
  };
  CHECK(last_temperature(0, "20 05 50 21 18 00 00") == 23.0);
  CHECK(last_temperature(1, "20 05 50 21 00 00 00") == 50.0);
}

TEST_CASE("the same bytes come however often anybody looks", "[simulated][board][property]") {
  const auto seed = GENERATE(range(0U, 20U));
  CAPTURE(seed);
  std::mt19937 random(seed);
  const auto listen = [&](bool often) {
    SimulatedRig rig({}, seed, 1, yinhe_profile(), 1);
    SimulatedBoard& board = rig.board(0);
    Bytes all;
    const auto look = [&](double t_s) {
      board.advance(at_s(t_s));
      const auto output = board.output();
      const std::size_t count = often ? random() % (output.size() + 1) : output.size();
      all.insert(all.end(), output.begin(), output.begin() + static_cast<std::ptrdiff_t>(count));
      board.take(count);
    };
    const auto say = [&](const char* packet, double t_s) {
      board.receive(bytes(packet), at_s(t_s));
    };
    say("20 01 00", 0);
    say("20 05 50 29 20 01 f4", 0.1);  // 30 Hz, 500 frames
    rig.chamber().set_at_panel(ChamberRun::running, at_s(0.5));
    say("20 01 52", 1);
    if (often) {
      for (int i = 0; i < 200; ++i) look(1 + 0.1 * i);
    }
    rig.chamber().set_at_panel(Celsius{-10}, at_s(21));
    say("20 05 50 38 30 00 00", 22);  // 400 Hz, with the accelerometer
    say("20 01 52", 22);
    if (often) {
      for (int i = 0; i < 100; ++i) look(22 + 0.03 * i);
    }
    say("20 01 53", 30);
    look(30);
    while (!board.output().empty()) look(30);
    return all;
  };
  const Bytes seldom = listen(false);
  CHECK(seldom.size() > 500 * 13 + 3000 * 17);
  CHECK(seldom == listen(true));
}
