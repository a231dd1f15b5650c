#include "daemon/status/concern.h"

#include <catch2/catch.hpp>

#include "tests/daemon/status/sample_view.h"

namespace gyrocal::status {
namespace {

Concern of(const runner::Snapshot& now) { return sample_view(now).concern; }

}  // namespace

SCENARIO("an undisturbed campaign says that nothing is wrong") {
  const Concern concern = of(sample_snapshot());
  CHECK(concern.severity == "info");
  CHECK(concern.sentence == "Nothing is wrong.");
  CHECK(concern.advice.empty());
}

SCENARIO("a trip says why, and how to go on") {
  auto now = sample_snapshot();
  now.state = "safe";
  now.why = "no reading of the chamber for 31 s";
  const Concern concern = of(now);
  CHECK(concern.severity == "error");
  CHECK(concern.sentence == "The campaign has tripped: no reading of the chamber for 31 s.");
  CHECK(concern.advice.find("gyrocal run weekend.toml --resume") != std::string::npos);
  CHECK(concern.advice.find("has NOT confirmed its safe setpoint") != std::string::npos);
  const EventInsert confirmed{0, 0, "info", "safe_setpoint", "the chamber has confirmed it"};
  CHECK(sample_view(now, {confirmed}).concern.advice.find("has confirmed its safe setpoint") !=
        std::string::npos);
}

SCENARIO("a board that is away is named with its reason") {
  auto now = sample_snapshot();
  now.each_board[1].present = false;
  now.each_board[1].trouble = "no frame for 10 s";
  CHECK(of(now).severity == "warning");
  CHECK(of(now).sentence == "Board right is away: no frame for 10 s.");
  now.each_board[1].given_up = true;
  CHECK(of(now).severity == "error");
}

SCENARIO("a chamber that has been silent for half its patience is a warning") {
  auto now = sample_snapshot();
  now.chamber_age = seconds(14);
  CHECK(of(now).severity == "info");
  now.chamber_age = seconds(16);
  CHECK(of(now).sentence ==
        "The chamber has not answered for 0:00:16; after 30 s the campaign trips.");
}

SCENARIO("frames lost beyond the limit of a dwell are a warning") {
  auto now = sample_snapshot();
  now.each_board[0].frames_missing = 110;
  CHECK(of(now).sentence.find("Board left has lost 1.1 % of its frames") == 0);
}

SCENARIO("a warning of the last minutes is told, an older one is not") {
  EventInsert event{seconds(990).count(), 0, "warning", "door", "somebody opened the door"};
  CHECK(sample_view(sample_snapshot(), {event}).concern.sentence ==
        "0:00:10 ago: somebody opened the door.");
  auto later = sample_snapshot();
  later.t = seconds(2000);
  CHECK(sample_view(later, {event}).concern.severity == "info");
}

SCENARIO("the second setpoint given up needs a person, and stays told") {
  const EventInsert first{seconds(100).count(), 0, "error", "setpoint_failed",
                          "setpoint 10.0 degC given up after one try: not stable"};
  EventInsert second = first;
  second.t_ns = seconds(900).count();
  CHECK(sample_view(sample_snapshot(), {first}).concern.severity == "warning");
  auto later = sample_snapshot();
  later.t = seconds(9000);
  later.since = seconds(8900);
  CHECK(sample_view(later, {first}).concern.severity == "info");
  const Concern concern = sample_view(later, {first, second}).concern;
  CHECK(concern.severity == "error");
  CHECK(concern.sentence ==
        "2 of 3 setpoints have been given up; the latest, 2:15:00 ago: setpoint 10.0 degC given up "
        "after one try: not stable.");
  CHECK(concern.advice.find("gyrocal abort weekend") != std::string::npos);
  CHECK(concern.advice.find("in weekend.toml") != std::string::npos);
  later.state = "safe";
  CHECK(sample_view(later, {first, second}).concern.sentence.find("has tripped") !=
        std::string::npos);
}

SCENARIO("a loop that has stopped reporting is noticed by the machine's clock") {
  LiveStatus live(sample_facts());
  CHECK(live.at(sample_utc_ns, 0).concern.sentence.find("has not begun") != std::string::npos);
  live.report(sample_snapshot(), 10);
  CHECK(live.at(sample_utc_ns, 40).concern.severity == "info");
  CHECK(live.at(sample_utc_ns, 41).concern.sentence ==
        "The daemon has not reported for 31 s of the machine's time.");
}

}  // namespace gyrocal::status
