#include "schema/session/import_session.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "schema/maintenance.h"
#include "tests/schema/small_session.h"
#include "tests/schema/temporary_folder.h"

using namespace gyrocal;

namespace {
const ImportNames names{"imported", "sessions/a", "0.1.0"};
}

TEST_CASE("an imported session comes out of the database as it went in", "[session][store]") {
  const TemporaryFolder folder;
  auto store = Store::open(folder / "a.db").value();
  auto session = small_session();
  session.samples.erase(session.samples.begin() + 4);  // a lost sample
  session.monitor[2].gyro_dps = missing;
  const auto id = import_session(store, session, names).value();

  CHECK(store.campaign(id).value().name == "imported");
  CHECK(store.campaign(id).value().state == "finished");
  const auto boards = store.boards(id).value();
  REQUIRE(boards.size() == 1);
  CHECK(boards[0].second.name == "bench");
  CHECK(boards[0].second.device == "sessions/a");
  CHECK(boards[0].second.measured == std::array<bool, 3>{false, true, false});

  const auto back = store.session(id, boards[0].first, Axis::y).value();
  CHECK(back.sample_rate_hz == 10);
  CHECK(back.lsb_dps == 0.25);
  REQUIRE(back.samples.size() == 23);
  for (std::size_t i = 0; i < back.samples.size(); ++i) {
    CHECK(back.samples[i].dwell == session.samples[i].dwell);
    CHECK(back.samples[i].seq == session.samples[i].seq);
    CHECK(back.samples[i].t_s == Approx(session.samples[i].t_s).margin(1e-9));
    CHECK(back.samples[i].gyro_dps == session.samples[i].gyro_dps);
    CHECK(back.samples[i].board_c == session.samples[i].board_c);
  }
  REQUIRE(back.monitor.size() == 12);
  CHECK(std::isnan(back.monitor[2].gyro_dps));
  CHECK(back.monitor[3].gyro_dps == Approx(session.monitor[3].gyro_dps).epsilon(1e-15));
  CHECK(back.monitor[3].chamber_c == 19.75);
  CHECK(back.dwells[1].setpoint_c == 20);
  CHECK(back.dwells[1].t_start_s == 40);
  const auto dwells = store.accepted_dwells(id, boards[0].first).value();
  CHECK(dwells[0].chamber_mean_c == 19.75);
  CHECK(dwells[0].board_mean_c == 21.5);
  CHECK(problems_in_database(folder / "a.db").value().empty());
}

TEST_CASE("a session whose rates are no counts is refused, nothing is stored", "[session][bad]") {
  const TemporaryFolder folder;
  auto store = Store::open(folder / "a.db").value();
  auto session = small_session();
  std::string message;
  SECTION("filtered data") {
    session.samples[3].gyro_dps = 4.1;
    message =
        "sessions/a: dwell 0, seq 3: 4.1 deg/s is 16.400 counts of lsb_dps = 0.25, expected a "
        "whole number up to 32767";
  }
  SECTION("a rate no count can hold") {
    session.samples[3].gyro_dps = 10000;
    message = "sessions/a: dwell 0, seq 3: 10000 deg/s is 40000.000 counts";
  }
  SECTION("a dwell without a setpoint") {
    session.dwells[1].setpoint_c = missing;
    message = "sessions/a: dwell 1 has no setpoint_c";
  }
  const auto refused = import_session(store, session, names);
  REQUIRE_FALSE(refused.has_value());
  CHECK_THAT(refused.error().what, Catch::StartsWith(message));
  CHECK_FALSE(store.latest_campaign().value().has_value());
}
