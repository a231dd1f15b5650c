#include <catch2/catch.hpp>
#include <cmath>

#include "tests/schema/small_campaign.h"
#include "tests/schema/temporary_folder.h"

using namespace gyrocal;

TEST_CASE("a session is the slow stream and the accepted dwells of one axis, in deg/s",
          "[store][session]") {
  const TemporaryFolder folder;
  auto store = Store::open(folder / "a.db").value();
  const auto ids = small_campaign::begin(store);
  auto rejected = small_campaign::dwell(ids.first, 1);
  rejected.reject_reason = "frames lost";
  const auto rows = small_campaign::samples(1, 5);
  REQUIRE(store.add_group(ids.campaign, std::vector<DwellWithSamples>{{rejected, rows}}));
  REQUIRE(small_campaign::log_group(store, ids, 2).has_value());
  const std::vector<MonitorInsert> monitor{
      {ids.first, 2'500'000'000, 20, 19.5, 30, {4, 0, 12}, 250, 0},
      {ids.first, 7'500'000'000, 20, missing, missing, {missing, missing, 10}, 250, 0},
      {ids.second, 2'500'000'000, 20, 19.5, 30, {8, 0, 12}, 250, 0}};
  REQUIRE(store.add_monitor(ids.campaign, monitor));

  const auto session = store.session(ids.campaign, ids.first, Axis::z).value();
  CHECK(session.device == "first");
  CHECK(session.axis == "z");
  CHECK(session.sample_rate_hz == 50);
  CHECK(session.monitor_interval_s == 5);
  CHECK(session.lsb_dps == 0.2);
  CHECK(session.samples_per_dwell == 5);
  REQUIRE(session.dwells.size() == 1);
  CHECK(session.dwells[0].dwell == 2);
  CHECK(session.dwells[0].setpoint_c == 50);
  CHECK(session.dwells[0].t_start_s == 2000);
  REQUIRE(session.samples.size() == 5);
  CHECK(session.samples[0].dwell == 2);
  CHECK(session.samples[4].seq == 4);
  CHECK(session.samples[1].t_s == Approx(2000.02).epsilon(1e-15));
  CHECK(session.samples[0].board_c == 30);
  CHECK(session.samples[0].gyro_dps == 10 / (5.0 + 0.1 * 10));  // the scale at 30 degC
  REQUIRE(session.monitor.size() == 2);
  CHECK(session.monitor[0].t_s == 2.5);
  CHECK(session.monitor[0].gyro_dps == 12 / (5.0 + 0.1 * 10));
  CHECK(session.monitor[1].gyro_dps == 2);  // no temperature: the scale at 20 degC
  CHECK(std::isnan(session.monitor[1].chamber_c));
  CHECK(std::isnan(store.session(ids.campaign, ids.first, Axis::x).value().monitor[1].gyro_dps));
}

TEST_CASE("an axis the board does not have gives no session", "[store][session][bad]") {
  const TemporaryFolder folder;
  auto store = Store::open(folder / "a.db").value();
  const auto points = small_campaign::setpoints();
  const auto campaign = store.begin_campaign(small_campaign::campaign(), points).value();
  auto board = small_campaign::board("z only");
  board.measured = {false, false, true};
  const auto id = store.add_board(campaign, board).value();
  const auto rows = small_campaign::samples(0, 2);
  REQUIRE(store.add_group(campaign,
                          std::vector<DwellWithSamples>{{small_campaign::dwell(id, 0), rows}}));
  CHECK(store.session(campaign, id, Axis::z).has_value());
  CHECK_FALSE(store.session(campaign, id, Axis::x).has_value());
  CHECK_FALSE(store.session(campaign, BoardId{99}, Axis::z).has_value());
  CHECK(store.boards(campaign).value()[0].second.measured == board.measured);
}
