// The tables refuse what must never be written, whoever writes it; nothing of the rest changes.
#include <catch2/catch.hpp>
#include <limits>

#include "tests/schema/small_campaign.h"
#include "tests/schema/temporary_folder.h"

using namespace gyrocal;

namespace {
constexpr double infinite = std::numeric_limits<double>::infinity();
}

TEST_CASE("a group with one impossible dwell is refused whole", "[store][bad]") {
  const TemporaryFolder folder;
  auto store = Store::open(folder / "a.db").value();
  const auto ids = small_campaign::begin(store);
  REQUIRE(small_campaign::log_group(store, ids, 0).has_value());
  const auto before = dump(folder / "a.db");
  const auto rows = small_campaign::samples(1, 5);
  auto bad = small_campaign::dwell(ids.second, 1);
  SECTION("a setpoint the plan does not have") { bad.ordinal = 3; }
  SECTION("a board nobody added") { bad.board = BoardId{99}; }
  SECTION("it ends before it starts") { bad.t_end_ns = bad.t_start_ns - 1; }
  SECTION("an infinite temperature") { bad.chamber_mean_c = infinite; }
  SECTION("a soak that lasted less than nothing") { bad.soak_s = -1; }
  SECTION("attempt 0") { bad.attempt = 0; }
  SECTION("an empty reason") { bad.reject_reason = ""; }
  SECTION("a second accepted dwell of a setpoint") {
    bad.ordinal = 0;
    bad.attempt = 2;
  }
  SECTION("the same attempt twice") {
    bad.ordinal = 0;
    bad.reject_reason = "frames lost";
  }
  const std::vector<DwellWithSamples> group{{small_campaign::dwell(ids.first, 1), rows},
                                            {bad, rows}};
  const auto refused = store.add_group(ids.campaign, group);
  REQUIRE_FALSE(refused.has_value());
  CHECK(refused.error().code == Errc::bad_input);
  CHECK_THAT(refused.error().what,
             Catch::StartsWith("store the dwells of setpoint 1: " + folder.path()));
  CHECK(dump(folder / "a.db") == before);
  CHECK(small_campaign::log_group(store, ids, 1).has_value());  // and the store goes on
}

TEST_CASE("a dwell's board and setpoint belong to one campaign", "[store][bad]") {
  const TemporaryFolder folder;
  auto store = Store::open(folder / "a.db").value();
  const auto first = small_campaign::begin(store);
  const auto second = small_campaign::begin(store);
  const std::vector<DwellWithSamples> group{{small_campaign::dwell(first.first, 0), {}}};
  CHECK_FALSE(store.add_group(second.campaign, group).has_value());
  const std::vector<MonitorInsert> monitor{{first.first, 0, 20, 20, 20, {1, 2, 3}, 1, 0}};
  const auto refused = store.add_monitor(second.campaign, monitor);
  REQUIRE_FALSE(refused.has_value());
  CHECK(refused.error().what == "store monitor rows: board 1 is not in campaign 2");
  CHECK(store.add_group(first.campaign, group).has_value());
}

TEST_CASE("a campaign that cannot be is refused", "[store][bad]") {
  const TemporaryFolder folder;
  auto store = Store::open(folder / "a.db").value();
  auto campaign = small_campaign::campaign();
  auto points = small_campaign::setpoints();
  SECTION("a state nobody knows") { campaign.state = "melting"; }
  SECTION("time faster than real on real devices") { campaign.simulated = false; }
  SECTION("a setpoint that is no number") { points[1].setpoint = Celsius{missing}; }
  SECTION("a setpoint below absolute zero") { points[1].setpoint = Celsius{-300}; }
  SECTION("an ordinal twice") { points[1].ordinal = 0; }
  SECTION("no name") { campaign.name = ""; }
  CHECK_FALSE(store.begin_campaign(campaign, points).has_value());
  CHECK(dump(folder / "a.db").empty());
}

TEST_CASE("boards, states, events and monitor rows that cannot be are refused", "[store][bad]") {
  const TemporaryFolder folder;
  auto store = Store::open(folder / "a.db").value();
  const auto ids = small_campaign::begin(store);
  const auto before = dump(folder / "a.db");
  CHECK_FALSE(store.add_board(ids.campaign, small_campaign::board("first")).has_value());
  auto board = small_campaign::board("third");
  board.lsb_per_dps[1] = 0;
  CHECK_FALSE(store.add_board(ids.campaign, board).has_value());
  CHECK_FALSE(store.add_board(CampaignId{9}, small_campaign::board("third")).has_value());
  CHECK_FALSE(store.set_campaign_state(ids.campaign, "").has_value());
  CHECK_FALSE(store.add_event(ids.campaign, {0, 0, "fatal", "a", "b"}).has_value());
  CHECK_FALSE(store.add_event(ids.campaign, {0, 0, "info", "", "b"}).has_value());
  const MonitorInsert row{ids.first, 5, 20, 20, 20, {1, 2, 3}, 250, 0};
  CHECK_FALSE(store.add_monitor(ids.campaign, std::vector{row, row}).has_value());
  auto hot = row;
  hot.board_c = 2000;
  CHECK_FALSE(store.add_monitor(ids.campaign, std::vector{hot}).has_value());
  CHECK(dump(folder / "a.db") == before);
}

TEST_CASE("an analysis with a number that is none leaves the former one", "[store][bad]") {
  const TemporaryFolder folder;
  auto store = Store::open(folder / "a.db").value();
  const auto ids = small_campaign::begin(store);
  const auto dwells = small_campaign::log_group(store, ids, 0).value();
  std::vector<DwellDriftInsert> drifts{{dwells[0], Axis::z, 4.1, 1.31, 4.11, 0.25, 0.02}};
  const AnalysisSettings settings{"{}", "0.1.0"};
  REQUIRE(store.add_analysis(ids.campaign, settings, drifts, {}));
  const auto before = dump(folder / "a.db");
  drifts[0].filtered_mean_dps = missing;
  CHECK_FALSE(store.add_analysis(ids.campaign, settings, drifts, {}).has_value());
  CHECK_FALSE(store.add_analysis(ids.campaign, {"not json", "0.1.0"}, {}, {}).has_value());
  CHECK(dump(folder / "a.db") == before);
}
