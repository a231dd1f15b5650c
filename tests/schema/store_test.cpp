#include "schema/store.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "schema/sqlite.h"
#include "tests/schema/small_campaign.h"
#include "tests/schema/temporary_folder.h"

using namespace gyrocal;

TEST_CASE("what a campaign stores is read back as it was", "[store]") {
  const TemporaryFolder folder;
  auto store = Store::open(folder / "a.db").value();
  const auto ids = small_campaign::begin(store);

  const auto campaign = store.campaign(ids.campaign).value();
  CHECK(campaign.name == "small");
  CHECK(campaign.config_toml == "[campaign]\nname = \"small\"\n");
  CHECK(campaign.utc_start_ns == 1'700'000'000'000'000'000);
  CHECK(campaign.simulated);
  CHECK(campaign.time_scale == 400);
  CHECK(campaign.monitor_interval_s == 5);
  CHECK(campaign.state == "preflight");
  CHECK(store.latest_campaign().value() == ids.campaign);

  const auto boards = store.boards(ids.campaign).value();
  REQUIRE(boards.size() == 2);
  CHECK(boards[0].first == ids.first);
  CHECK(boards[0].second.device == "/dev/first");
  CHECK(boards[1].second.lsb_per_dps == std::array<double, 3>{4.0, 4.13, 5.0});
  CHECK(boards[1].second.lsb_per_dps_per_k == std::array<double, 3>{0.0, 0.0, 0.1});
}

TEST_CASE("the samples of a dwell come back with counters, times and counts", "[store]") {
  const TemporaryFolder folder;
  auto store = Store::open(folder / "a.db").value();
  const auto ids = small_campaign::begin(store);
  auto logged = small_campaign::samples(1, 5);
  logged[3].temperature_raw.reset();

  SECTION("none lost") {}
  SECTION("two lost: a hole in seq") {
    logged[2].counter += 2;
    logged[3].counter += 2;
    logged[4].counter += 2;
  }
  SECTION("the board restarted in the middle and counts from 1") {
    logged[2].counter = 1;
    logged[3].counter = 2;
    logged[4].counter = 3;
  }
  SECTION("the board restarted twice") {
    logged[1].counter = 50;
    logged[3].counter = 7;
  }
  const std::vector<DwellWithSamples> group{{small_campaign::dwell(ids.first, 1), logged}};
  const auto dwells = store.add_group(ids.campaign, group).value();
  REQUIRE(dwells.size() == 1);
  CHECK(store.samples(dwells[0]).value() == logged);
}

TEST_CASE("a hole in the counter is a hole in seq", "[store]") {
  const TemporaryFolder folder;
  auto store = Store::open(folder / "a.db").value();
  const auto ids = small_campaign::begin(store);
  auto logged = small_campaign::samples(0, 3);
  logged[2].counter += 4;
  const std::vector<DwellWithSamples> group{{small_campaign::dwell(ids.first, 0), logged}};
  REQUIRE(store.add_group(ids.campaign, group).has_value());
  const auto database = Database::open(folder / "a.db", OpenMode::read_only).value();
  CHECK(database.integer("SELECT max(seq) FROM sample").value() == 6);
  CHECK(database.integer("SELECT count(counter) FROM sample").value() == 0);  // all told by seq
}

TEST_CASE("a resumed campaign finds its boards, all dwells and the latest time", "[store]") {
  const TemporaryFolder folder;
  auto store = Store::open(folder / "a.db").value();
  CHECK_FALSE(store.open_campaign().value().has_value());
  const auto ids = small_campaign::begin(store);
  REQUIRE(small_campaign::log_group(store, ids, 0).has_value());
  auto disturbed = small_campaign::dwell(ids.first, 1);
  disturbed.reject_reason = "the door was opened";
  REQUIRE(store.add_group(ids.campaign, std::vector<DwellWithSamples>{{disturbed, {}}}));
  const MonitorInsert row{ids.second, 2'000'000'000'000, 20, 20, 20, {1, 2, 3}, 250, 0};
  REQUIRE(store.add_monitor(ids.campaign, std::vector{row}));
  REQUIRE(store.set_campaign_state(ids.campaign, "holding"));

  const auto open = store.open_campaign().value();
  REQUIRE(open.has_value());
  CHECK(open->id == ids.campaign);
  CHECK(open->campaign.state == "holding");
  CHECK(open->boards.size() == 2);
  CHECK(open->t_last_ns == 2'000'000'000'000);
  REQUIRE(open->dwells.size() == 3);
  CHECK_FALSE(open->dwells[0].reject_reason.has_value());
  CHECK(open->dwells[0].timed_soak);
  CHECK(open->dwells[2].reject_reason == "the door was opened");

  REQUIRE(store.add_event(ids.campaign, {3'000'000'000'000, 0, "info", "transition", "done"}));
  CHECK(store.open_campaign().value()->t_last_ns == 3'000'000'000'000);
  REQUIRE(store.set_campaign_state(ids.campaign, "finished"));
  CHECK_FALSE(store.open_campaign().value().has_value());
}

TEST_CASE("only accepted dwells reach the analysis, in the order of the setpoints", "[store]") {
  const TemporaryFolder folder;
  auto store = Store::open(folder / "a.db").value();
  const auto ids = small_campaign::begin(store);
  REQUIRE(small_campaign::log_group(store, ids, 2).has_value());
  auto disturbed = small_campaign::dwell(ids.first, 0);
  disturbed.reject_reason = "frames lost";
  disturbed.board_mean_c = missing;
  REQUIRE(store.add_group(ids.campaign, std::vector<DwellWithSamples>{{disturbed, {}}}));
  auto repeated = small_campaign::dwell(ids.first, 0, 2);
  repeated.board_mean_c = missing;
  REQUIRE(store.add_group(ids.campaign, std::vector<DwellWithSamples>{{repeated, {}}}));

  const auto dwells = store.accepted_dwells(ids.campaign, ids.first).value();
  REQUIRE(dwells.size() == 2);
  CHECK(dwells[0].ordinal == 0);
  CHECK(dwells[0].setpoint == Celsius{-10});
  CHECK(std::isnan(dwells[0].board_mean_c));
  CHECK(dwells[1].setpoint == Celsius{50});
  CHECK(dwells[1].chamber_mean_c == 30.1);
}

TEST_CASE("an analysis is read back whole; the same settings replace it, others stand beside it",
          "[store]") {
  const TemporaryFolder folder;
  auto store = Store::open(folder / "a.db").value();
  const auto ids = small_campaign::begin(store);
  const auto dwells = small_campaign::log_group(store, ids, 0).value();
  const AnalysisSettings settings{R"({"wavelet":"db4"})", "0.1.0"};
  const std::vector<DwellDriftInsert> drifts{{dwells[0], Axis::z, 4.1, 1.31, 4.11, 0.25, 0.02},
                                             {dwells[0], Axis::x, 3.1, 1.31, 3.11, 0.25, missing}};
  ModelInsert model;
  model.board = ids.first;
  model.axis = Axis::z;
  model.method = "gm11";
  model.parameters_json = R"({"a":0.003})";
  model.rmse_dps = 0.0445;
  model.recommended = true;
  model.reason = "smallest leave-one-out error";
  model.dwells_sha256 = "abc";
  model.dwells = {dwells[0]};
  model.points = {{-10, 4.11, 4.10, 0.2}};
  model.block_rmse_dps = 0.06;
  model.warnings = "one\ntwo";
  REQUIRE(store.add_analysis(ids.campaign, settings, drifts, std::vector{model}));

  const auto check = [&](double rmse) {
    const auto models = store.models(ids.campaign, ids.first, Axis::z).value();
    REQUIRE(models.size() == 1);
    CHECK(models[0].method == "gm11");
    CHECK(models[0].rmse_dps == rmse);
    CHECK(std::isnan(models[0].loocv_rmse_dps));
    CHECK(models[0].recommended);
    CHECK(models[0].dwells == std::vector{dwells[0]});
    REQUIRE(models[0].points.size() == 1);
    CHECK(models[0].points[0].fitted_dps == 4.10);
    CHECK(models[0].points[0].band_dps == 0.2);
    CHECK(models[0].block_rmse_dps == 0.06);
    CHECK(std::isnan(models[0].effective_parameters));
    CHECK(models[0].warnings == "one\ntwo");
    CHECK(store.models(ids.campaign, ids.second, Axis::z).value().empty());
  };
  check(0.0445);
  CHECK(store.drifts(ids.campaign, ids.first, Axis::z).value().at(0).filtered_mean_dps == 4.11);
  CHECK(
      std::isnan(store.drifts(ids.campaign, ids.first, Axis::x).value().at(0).standard_error_dps));
  CHECK(store.analysis_settings(ids.campaign).value()->settings_json == R"({"wavelet":"db4"})");

  model.rmse_dps = 0.05;
  REQUIRE(store.add_analysis(ids.campaign, settings, drifts, std::vector{model}));
  check(0.05);
  model.rmse_dps = 0.06;
  REQUIRE(store.add_analysis(ids.campaign, {R"({"wavelet":"sym4"})", "0.1.0"}, drifts,
                             std::vector{model}));
  check(0.06);
  const auto database = Database::open(folder / "a.db", OpenMode::read_only).value();
  CHECK(database.integer("SELECT count(*) FROM analysis").value() == 2);
  CHECK(database.integer("SELECT count(*) FROM model_point").value() == 2);
}

TEST_CASE("a campaign that does not exist is said so", "[store][bad]") {
  const TemporaryFolder folder;
  auto store = Store::open(folder / "a.db").value();
  CHECK_FALSE(store.latest_campaign().value().has_value());
  const auto missing_campaign = store.campaign(CampaignId{7});
  REQUIRE_FALSE(missing_campaign.has_value());
  CHECK(missing_campaign.error().what == folder / "a.db" + ": no campaign 7");
}

TEST_CASE("the same writes give the same content, byte by byte", "[store][property]") {
  const TemporaryFolder folder;
  for (const char* name : {"a.db", "b.db"}) {
    auto store = Store::open(folder / name).value();
    const auto ids = small_campaign::begin(store);
    REQUIRE(small_campaign::log_group(store, ids, 0, 300).has_value());
    REQUIRE(small_campaign::log_group(store, ids, 1, 300).has_value());
    REQUIRE(store.add_event(ids.campaign, {1, 2, "info", "transition", "soaking"}));
  }
  CHECK(dump(folder / "a.db") == dump(folder / "b.db"));
  CHECK(dump(folder / "a.db").size() > 10000);
}
