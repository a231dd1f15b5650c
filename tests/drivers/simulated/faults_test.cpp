#include <catch2/catch.hpp>

#include "drivers/big_endian.h"
#include "drivers/clocks.h"
#include "drivers/simulated/in_process_links.h"
#include "tests/drivers/simulated/bench_board.h"

using namespace gyrocal;

namespace {

const std::string ask_actual = "01 03 00 a0 00 02";
const std::string ask_setpoint = "01 03 06 ce 00 02";
const std::string set_22 = "01 10 06 ce 00 02 04 41 b0 00 00";

RigFault chamber_fault(RigFaultKind kind, double value = 0) { return {kind, 10, 5, {}, value}; }
RigFault board_fault(RigFaultKind kind, double value = 0) { return {kind, 10, 5, 0, value}; }

struct FaultyChamber {
  explicit FaultyChamber(const RigFault& fault) : rig({}, 1, 0, yinhe_profile(), 1) {
    rig.set_faults({fault});
  }
  ChamberAnswer at(double t_s, const std::string& request = ask_actual) {
    return rig.chamber().exchange(bytes(request), at_s(t_s));
  }
  std::string reply_at(double t_s, const std::string& request = ask_actual) {
    const auto answer = at(t_s, request);
    CHECK(answer.way == ChamberAnswer::Way::whole);
    return hex(answer.reply);
  }
  SimulatedRig rig;
};

/// A board that streams gyro frames (11 bytes) from the start, at 50 Hz.
struct FaultyBoard : BenchBoard {
  explicit FaultyBoard(const RigFault& fault, const char* mode = "28 18 00 00")
      : BenchBoard(still_model({17, -3, 5})) {
    rig.set_faults({fault});
    say("20 01 00");
    say(fmt::format("20 05 50 {}", mode));
    say("20 01 52");
  }
  std::vector<int> counters_until(double t_s) {
    board.advance(at_s(t_s));
    std::vector<int> found;
    for (std::size_t at = 0; at + 11 <= board.output().size(); at += 11) {
      found.push_back(get_u16(board.output(), at + 3));
    }
    board.take(board.output().size());
    return found;
  }
};

}  // namespace

TEST_CASE("a fault of the chamber begins and ends at its time", "[simulated][fault]") {
  using Way = ChamberAnswer::Way;
  SECTION("refuse") {
    FaultyChamber chamber(chamber_fault(RigFaultKind::refuse));
    CHECK(chamber.at(9.9).way == Way::whole);
    CHECK(chamber.at(10).way == Way::hang_up);
    CHECK(chamber.rig.chamber().refuses());
    CHECK(chamber.at(15).way == Way::whole);
    CHECK_FALSE(chamber.rig.chamber().refuses());
  }
  SECTION("late") {
    FaultyChamber chamber(chamber_fault(RigFaultKind::late, 2.5));
    CHECK(chamber.at(9.9).delay == seconds(0));
    CHECK(chamber.at(12).delay == seconds(2.5));
    CHECK(chamber.at(15).delay == seconds(0));
  }
  SECTION("half and doubled") {
    CHECK(FaultyChamber(chamber_fault(RigFaultKind::half)).at(12).way == Way::half);
    CHECK(FaultyChamber(chamber_fault(RigFaultKind::doubled)).at(12).way == Way::twice);
  }
  SECTION("lost: carried out, not answered") {
    FaultyChamber chamber(chamber_fault(RigFaultKind::lost));
    CHECK(chamber.at(12, set_22).way == Way::silence);
    CHECK(chamber.rig.chamber().setpoint() == Celsius{22});
  }
  SECTION("exception: answered, not carried out") {
    FaultyChamber chamber(chamber_fault(RigFaultKind::exception, 6));
    CHECK(chamber.reply_at(12, set_22) == "01 90 06");
    CHECK(chamber.rig.chamber().setpoint() == Celsius{25});
  }
  SECTION("wrong unit") {
    FaultyChamber chamber(chamber_fault(RigFaultKind::wrong_unit));
    CHECK(chamber.reply_at(12) == "02 03 04 41 b8 00 00");
  }
  SECTION("wrong register: the setpoint for the actual value, and another echo") {
    FaultyChamber chamber(chamber_fault(RigFaultKind::wrong_register));
    CHECK(chamber.reply_at(12) == "01 03 04 41 c8 00 00");
    CHECK(chamber.reply_at(12, ask_setpoint) == "01 03 04 41 b8 00 00");
    CHECK(chamber.reply_at(12, set_22) == "01 10 06 d0 00 02");
    CHECK(chamber.rig.chamber().setpoint() == Celsius{22});
  }
  SECTION("wrong value and spurious zero") {
    CHECK(FaultyChamber(chamber_fault(RigFaultKind::wrong_value, 5)).reply_at(12) ==
          "01 03 04 41 e0 00 00");  // 28 degC
    CHECK(FaultyChamber(chamber_fault(RigFaultKind::spurious_zero)).reply_at(12) ==
          "01 03 04 00 00 00 00");
  }
  SECTION("dead: silent, and stopped when the mains are back") {
    FaultyChamber chamber(chamber_fault(RigFaultKind::dead));
    chamber.at(5, "01 10 00 c8 00 01 02 00 01");
    CHECK(chamber.at(12).way == Way::silence);
    CHECK(chamber.reply_at(16, "01 03 00 c8 00 01") == "01 03 02 00 00");
  }
}

TEST_CASE("a stuck thermometer shows what it showed when it stuck, the air goes on",
          "[simulated][fault]") {
  FaultyChamber chamber({RigFaultKind::stuck, 600, 600, {}, 0});
  chamber.rig.chamber().set_at_panel(Celsius{60}, at_s(0));
  chamber.rig.chamber().set_at_panel(ChamberRun::running, at_s(0));
  const auto shown = [&](double t_s) { return chamber.reply_at(t_s); };
  const std::string before = shown(600);
  CHECK(shown(1199) == before);
  CHECK(chamber.rig.chamber().actual(at_s(1199)).value > 42);
  CHECK(shown(1200) != before);
}

TEST_CASE("a hand on the panel acts at its own time, even if nobody asks for an hour",
          "[simulated][fault]") {
  FaultyChamber chamber({RigFaultKind::panel_setpoint, 10, 0, {}, 40});
  chamber.at(5, "01 10 00 c8 00 01 02 00 01");
  CHECK(chamber.reply_at(3600, ask_setpoint) == "01 03 04 42 20 00 00");
  CHECK(chamber.rig.chamber().actual(at_s(610)).value == Approx(33).margin(0.4));
}

TEST_CASE("in process a dead chamber is a time-out and a refusing one a lost link",
          "[simulated][fault]") {
  VirtualClock clock;
  SimulatedRig rig({}, 1, 0, yinhe_profile(), 1);
  rig.set_faults({chamber_fault(RigFaultKind::dead),
                  {RigFaultKind::refuse, 20, 5, {}, 0},
                  {RigFaultKind::late, 30, 5, {}, 0.4},
                  {RigFaultKind::half, 40, 5, {}, 0}});
  InProcessChamberLink link(rig.chamber(), clock, seconds(1));
  const auto ask_at = [&](double t_s) {
    clock.sleep_until(at_s(t_s));
    return link.transact(bytes(ask_actual));
  };
  CHECK(ask_at(12).error().code == Errc::timeout);
  CHECK(clock.now() == at_s(13));
  CHECK(ask_at(21).error().code == Errc::link_lost);
  CHECK(ask_at(31).has_value());
  CHECK(clock.now() == at_s(31.4));
  CHECK(ask_at(41).error().code == Errc::timeout);
  CHECK(ask_at(50).has_value());
}

TEST_CASE("an unplugged board is away and comes back as new", "[simulated][fault]") {
  FaultyBoard board(board_fault(RigFaultKind::unplug));
  CHECK(board.counters_until(9.99).size() == 499);
  board.board.advance(at_s(12));
  CHECK_FALSE(board.board.present());
  board.board.advance(at_s(15));
  CHECK(board.board.present());
  CHECK(board.say("20 01 51", 16) == "c0 02 51 05");
}

TEST_CASE("a mute board says and hears nothing, then goes on counting", "[simulated][fault]") {
  FaultyBoard board(board_fault(RigFaultKind::mute));
  board.counters_until(10.001);
  CHECK(board.say("20 01 10", 12).empty());
  const auto after = board.counters_until(15.02);
  CHECK(after == std::vector<int>{501, 502});
}

TEST_CASE("a brown-out is silence with no gap in the bus", "[simulated][fault]") {
  FaultyBoard board({RigFaultKind::reset, 10, 0, 0, 0});
  board.counters_until(10.001);
  CHECK(board.counters_until(20).empty());
  CHECK(board.board.present());
  CHECK(board.say("20 01 51", 20) == "c0 02 51 05");
}

TEST_CASE("dropped frames leave gaps, duplicates repeat, garbage breaks frames; then all is well",
          "[simulated][fault]") {
  SECTION("drop all") {
    FaultyBoard board(board_fault(RigFaultKind::drop, 1));
    board.counters_until(9.99);
    CHECK(board.counters_until(15.03) == std::vector<int>{500, 751});
  }
  SECTION("drop a tenth") {
    FaultyBoard board(board_fault(RigFaultKind::drop, 0.1));
    board.counters_until(9.99);
    const auto during = board.counters_until(14.99);
    CHECK(during.size() > 200);
    CHECK(during.size() < 245);
  }
  SECTION("duplicate all") {
    FaultyBoard board(board_fault(RigFaultKind::duplicate, 1));
    board.counters_until(14.959);
    CHECK(board.counters_until(14.961) == std::vector<int>{748, 748});
    CHECK(board.counters_until(15.001) == std::vector<int>{749, 749, 750, 750});
  }
  SECTION("garbage") {
    FaultyBoard board(board_fault(RigFaultKind::garbage, 0.5));
    board.counters_until(9.99);
    board.board.advance(at_s(15));
    CHECK(board.board.output().size() != 251 * 11);
    board.board.take(board.board.output().size());
    CHECK(board.counters_until(15.05) == std::vector<int>{751, 752});
  }
}

TEST_CASE("a fault list with a seed gives the same bytes, however often anybody looks",
          "[simulated][fault][property]") {
  const auto listen = [](double step_s) {
    SimulatedRig rig({}, 5, 1, yinhe_profile(), 1);
    rig.set_faults({{RigFaultKind::garbage, 3, 20, 0, 0.3},
                    {RigFaultKind::drop, 5, 10, 0, 0.3},
                    {RigFaultKind::mute, 12, 3, 0, 0},
                    {RigFaultKind::panel_setpoint, 4, 0, {}, 60}});
    rig.chamber().set_at_panel(ChamberRun::running, at_s(0));
    SimulatedBoard& board = rig.board(0);
    for (const char* packet : {"20 01 00", "20 05 50 29 18 00 00", "20 01 52"}) {
      board.receive(bytes(packet), at_s(0));
    }
    for (double t_s = step_s; t_s < 30; t_s += step_s) board.advance(at_s(t_s));
    board.advance(at_s(30));
    return hex(board.output());
  };
  const std::string reference = listen(30);
  CHECK(reference.size() > 30000);
  CHECK(listen(0.37) == reference);
  CHECK(listen(5) == reference);
}

TEST_CASE("a fault changes nothing before it begins", "[simulated][fault]") {
  const auto first_ten_seconds = [](std::vector<RigFault> faults) {
    SimulatedRig rig({}, 5, 1, yinhe_profile(), 1);
    rig.set_faults(std::move(faults));
    SimulatedBoard& board = rig.board(0);
    for (const char* packet : {"20 01 00", "20 05 50 29 18 00 00", "20 01 52"}) {
      board.receive(bytes(packet), at_s(0));
    }
    board.advance(at_s(9.99));
    return hex(board.output());
  };
  CHECK(first_ten_seconds({}) == first_ten_seconds({board_fault(RigFaultKind::garbage, 1)}));
}
