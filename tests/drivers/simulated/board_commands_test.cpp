#include <catch2/catch.hpp>

#include "tests/drivers/simulated/bench_board.h"

using namespace gyrocal;

namespace {
struct Connected : BenchBoard {
  Connected() { say("20 01 00"); }
};
}  // namespace

TEST_CASE("Connect is acknowledged, and a second one too", "[simulated][board]") {
  BenchBoard board;
  CHECK(board.say("20 01 00") == "80 01 00");
  CHECK(board.say("20 01 00") == "80 01 00");
}

TEST_CASE("before Connect every other command is refused as not connected", "[simulated][board]") {
  for (const int id : {0x01, 0x02, 0x07, 0x08, 0x10, 0x12, 0x13, 0x50, 0x52, 0x53, 0x19}) {
    BenchBoard board;
    CHECK(board.say(fmt::format("20 01 {:02x}", id)) == fmt::format("c0 02 {:02x} 05", id));
  }
}

TEST_CASE("after Disconnect commands are refused again", "[simulated][board]") {
  Connected board;
  CHECK(board.say("20 01 01") == "80 01 01");
  CHECK(board.say("20 01 13") == "c0 02 13 05");
}

TEST_CASE("a board tells who it is", "[simulated][board]") {
  Connected board;
  CHECK(board.say("20 01 10") == "80 02 10 00");
  CHECK(board.say("20 01 12") == "80 0d 12 00 00 16 51 37 32 52 47 05 d8 ff 30");
  CHECK(board.say("20 01 13") ==
        "80 1b 13 69 4e 45 4d 4f 20 46 69 72 6d 77 61 72 65 5f 56 65 72 73 69 6f 6e 5f 32 2e 32");
  CHECK(board.say("20 01 14") ==
        "80 1c 14 69 4e 45 4d 4f 20 56 32 20 48 61 72 64 77 61 72 65 5f 56 65 72 73 69 6f 6e 5f "
        "31");
  CHECK(board.say("20 01 18") == "80 02 18 00");
}

TEST_CASE("two boards have two ids, and the seed changes neither", "[simulated][board]") {
  SimulatedRig one({}, 1, 2, yinhe_profile(), 1);
  SimulatedRig other({}, 2, 2, yinhe_profile(), 1);
  const auto id_of = [](SimulatedBoard& board) {
    board.receive(bytes("20 01 00"), at_s(0));
    board.receive(bytes("20 01 12"), at_s(0));
    return hex(board.output());
  };
  const std::string first = id_of(one.board(0));
  CHECK(first != id_of(one.board(1)));
  CHECK(first == id_of(other.board(0)));
}

TEST_CASE("the light is switched with 0 and 1 and nothing else", "[simulated][board]") {
  Connected board;
  CHECK(board.say("20 02 08 00") == "80 01 08");
  CHECK(board.say("20 02 08 01") == "80 01 08");
  CHECK(board.say("20 02 08 02") == "c0 02 08 02");
}

TEST_CASE("a firmware without trace answers nothing to Trace", "[simulated][board]") {
  Connected board;
  CHECK(board.say("20 02 07 01").empty());
  CHECK(board.say("20 01 10") == "80 02 10 00");
}

TEST_CASE("a firmware without AHRS has no AHRS version, output or sensor rate",
          "[simulated][board]") {
  Connected board;
  CHECK(board.say("20 01 17") == "c0 02 17 01");
  CHECK(board.say("20 05 50 a8 18 00 00") == "c0 02 50 02");
  CHECK(board.say("20 05 50 28 38 00 00") == "c0 02 50 02");
}

TEST_CASE("commands of the M1 and unknown ones are unsupported", "[simulated][board]") {
  Connected board;
  for (const int id : {0x19, 0x23, 0x24, 0x54, 0x60, 0x61, 0x04, 0xff}) {
    CHECK(board.say(fmt::format("20 01 {:02x}", id)) == fmt::format("c0 02 {:02x} 01", id));
  }
}

TEST_CASE("a packet must be one command: control 20, its length, nothing more",
          "[simulated][board]") {
  Connected board;
  SECTION("another control byte") {
    CHECK(board.say("00 01 10") == "c0 02 10 04");
    CHECK(board.say("21 01 10") == "c0 02 10 04");
    CHECK(board.say("30 01 10") == "c0 02 10 04");
  }
  SECTION("two commands in one write") { CHECK(board.say("20 01 53 20 01 13") == "c0 02 53 04"); }
  SECTION("half a command") { CHECK(board.say("20 05 50 28 18") == "c0 02 50 04"); }
  SECTION("a payload that does not belong there, or is missing") {
    CHECK(board.say("20 02 13 00") == "c0 02 13 04");
    CHECK(board.say("20 01 08") == "c0 02 08 04");
    CHECK(board.say("20 04 50 28 18 00") == "c0 02 50 04");
  }
  SECTION("less than a header") {
    CHECK(board.say("20") == "c0 02 00 04");
    CHECK(board.say("20 01") == "c0 02 00 04");
  }
  SECTION("and the next good command is understood") {
    CHECK(board.say("41 54 0d") == "c0 02 0d 04");
    CHECK(board.say("20 01 10") == "80 02 10 00");
  }
}

TEST_CASE("the output mode is what was set, and all sensors at 50 Hz at first",
          "[simulated][board]") {
  Connected board;
  CHECK(board.say("20 01 51") == "80 05 51 1f 18 00 00");
  CHECK(board.say("20 05 50 28 18 0b b8") == "80 01 50");
  CHECK(board.say("20 01 51") == "80 05 51 28 18 0b b8");
}

TEST_CASE("an output mode with forbidden bits is out of range and changes nothing",
          "[simulated][board]") {
  Connected board;
  for (const char* rate : {"19", "1c", "58", "98"}) {
    CHECK(board.say(fmt::format("20 05 50 28 {} 00 00", rate)) == "c0 02 50 02");
  }
  CHECK(board.say("20 01 51") == "80 05 51 1f 18 00 00");
}

TEST_CASE("settings are forbidden while data streams, questions are not", "[simulated][board]") {
  Connected board;
  CHECK(board.say("20 01 52") == "80 01 52");
  CHECK(board.say("20 05 50 28 18 00 00") == "c0 02 50 00");
  CHECK(board.say("20 04 20 02 00 08") == "c0 02 20 00");
  CHECK(board.say("20 03 22 02 01") == "c0 02 22 00");
  CHECK(board.say("20 01 51") == "80 05 51 1f 18 00 00");
  CHECK(board.say("20 01 53") == "80 01 53");
  CHECK(board.say("20 05 50 28 18 00 00") == "80 01 50");
}

TEST_CASE("sensor parameters are set, told and restored", "[simulated][board]") {
  Connected board;
  SECTION("full scale of roll and pitch: 04 or 08") {
    CHECK(board.say("20 03 21 02 00") == "80 04 21 02 00 04");
    CHECK(board.say("20 04 20 02 00 08") == "80 01 20");
    CHECK(board.say("20 03 21 02 00") == "80 04 21 02 00 08");
    CHECK(board.say("20 04 20 02 00 05") == "c0 02 20 02");
  }
  SECTION("the yaw gyro has one full scale") {
    CHECK(board.say("20 04 20 03 00 04") == "80 01 20");
    CHECK(board.say("20 04 20 03 00 08") == "c0 02 20 02");
  }
  SECTION("offsets are two bytes") {
    for (const char* which : {"02 01", "02 02", "03 01", "04 01", "05 00"}) {
      CHECK(board.say(fmt::format("20 05 20 {} ff fe", which)) == "80 01 20");
      CHECK(board.say(fmt::format("20 03 21 {}", which)) ==
            fmt::format("80 05 21 {} ff fe", which));
      CHECK(board.say(fmt::format("20 03 22 {}", which)) == "80 01 22");
      CHECK(board.say(fmt::format("20 03 21 {}", which)) ==
            fmt::format("80 05 21 {} 00 00", which));
      CHECK(board.say(fmt::format("20 04 20 {} ff", which)) == "c0 02 20 04");
    }
  }
  SECTION("the pressure sensor's rate is 1 or 3") {
    CHECK(board.say("20 04 20 04 00 03") == "80 01 20");
    CHECK(board.say("20 03 21 04 00") == "80 04 21 04 00 03");
    CHECK(board.say("20 04 20 04 00 02") == "c0 02 20 02");
  }
  SECTION("restoring a gyro's full scale always fails, the firmware's length bug") {
    CHECK(board.say("20 03 22 02 00") == "c0 02 22 03");
    CHECK(board.say("20 03 22 03 00") == "c0 02 22 03");
  }
  SECTION("no such sensor or parameter") {
    CHECK(board.say("20 03 21 06 00") == "c0 02 21 02");
    CHECK(board.say("20 04 20 05 01 00") == "c0 02 20 02");
    CHECK(board.say("20 03 22 02 03") == "c0 02 22 02");
  }
}

TEST_CASE("Identify blinks for 3.5 s; the last command sent meanwhile is answered then",
          "[simulated][board]") {
  Connected board;
  CHECK(board.say("20 01 15", 10) == "80 01 15");
  CHECK(board.say("20 01 13", 11).empty());
  CHECK(board.say("20 01 10", 12).empty());
  CHECK(board.heard(13.499).empty());
  CHECK(board.heard(13.5) == "80 02 10 00");
  CHECK(board.say("20 01 10", 13.6) == "80 02 10 00");
}

TEST_CASE("Reset takes the board from the bus after 5 s and it comes back forgetful",
          "[simulated][board]") {
  Connected board;
  board.say("20 05 50 28 18 0b b8");
  const auto appearance = board.board.appearance();
  CHECK(board.say("20 01 02", 10) == "80 01 02");
  CHECK(board.say("20 01 10", 12).empty());
  board.heard(14.9);
  CHECK(board.board.present());
  board.heard(15.5);
  CHECK_FALSE(board.board.present());
  board.heard(16.0);
  CHECK(board.board.present());
  CHECK(board.board.appearance() == appearance + 1);
  CHECK(board.say("20 01 51", 17) == "c0 02 51 05");
  board.say("20 01 00", 17);
  CHECK(board.say("20 01 51", 17) == "80 05 51 1f 18 00 00");
}

TEST_CASE("Enter DFU loses the board for good: never send it", "[simulated][board]") {
  Connected board;
  CHECK(board.board.present());
  board.board.receive(bytes("20 01 03"), at_s(1));
  board.heard(86400);
  CHECK_FALSE(board.board.present());
}
