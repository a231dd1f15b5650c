#include "daemon/report/campaign_report.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <random>

#include "daemon/report/acceptance.h"
#include "daemon/runner/analysis.h"
#include "tests/schema/temporary_folder.h"

using namespace gyrocal;
using namespace gyrocal::report;

namespace {

constexpr int setpoints = 8;
constexpr int samples = 600;

const std::string config_text =
    "[campaign]\nname = \"<b>bold\"\nsimulated = true\n[plan]\nsetpoints_c = [-10, 0, 10, 20, "
    "30, 40, 50, 60]\nsamples_per_setpoint = 600\n[chamber]\nprofile = \"yinhe\"\nhost = "
    "\"127.0.0.1\"\n[[board]]\nname = \"a\"\ndevice = \"/dev/a\"\n[acceptance]\npass_dps = "
    "0.001\nreject_dps = 5\n";

std::vector<BoardSample> dwell(int ordinal, std::mt19937& random) {
  std::normal_distribution<double> noise(0, 5);
  std::vector<BoardSample> rows(samples);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    rows[i].t_ns = std::int64_t(i) * 20'000'000;
    rows[i].counter = std::uint32_t(i + 1);
    rows[i].temperature_raw = std::int16_t(256 * (10 * ordinal - 9));
    for (auto& lsb : rows[i].gyro_lsb) {
      lsb = std::int16_t(std::lround(17 + ordinal * ordinal / 10.0 + noise(random)));
    }
  }
  return rows;
}

/// A campaign of one board, rejected first attempt and all, analysed or not.
std::string database(const TemporaryFolder& folder, bool analysed) {
  const std::string path = folder / "a.db";
  auto store = Store::open(path).value();
  CampaignRow row;
  row.name = "<b>bold";
  row.config_toml = config_text;
  row.software_version = "0.1.0";
  row.simulated = true;
  row.samples_per_setpoint = samples;
  row.sample_rate_hz = 50;
  row.state = analysed ? "finished" : "logging";
  std::vector<SetpointRow> plan;
  for (int i = 0; i < setpoints; ++i) plan.push_back({i, {10.0 * i - 10}});
  const auto id = store.begin_campaign(row, plan).value();
  BoardRow board;
  board.name = "a";
  board.lsb_per_dps = {4.13, 4.13, 4.13};
  const auto board_id = store.add_board(id, board).value();
  std::mt19937 random(8);
  for (int i = 0; i < setpoints; ++i) {
    for (int attempt = i == 3 ? 1 : 2; attempt <= 2; ++attempt) {
      DwellRow one;
      one.board = board_id;
      one.ordinal = i;
      one.attempt = attempt;
      one.t_start_ns = std::int64_t(1e12) * (2 * i + attempt);
      one.t_end_ns = one.t_start_ns + std::int64_t(12e9);
      one.board_mean_c = 10.0 * i - 9;
      if (attempt == 1) one.reject_reason = "the chamber left its band & came back";
      const auto rows = dwell(i, random);
      REQUIRE(store.add_group(id, std::array{DwellWithSamples{one, rows}}).has_value());
    }
  }
  const std::vector<MonitorInsert> monitor{
      {board_id, 0, 20, 20, 20, {17, 17, 17}, 250, 0},
      {board_id, 5'000'000'000, 20, 21, 20, {17, 17, 17}, 250, 0}};
  REQUIRE(store.add_monitor(id, monitor).has_value());
  REQUIRE(
      store.add_event(id, {1, 1, "warning", "chamber_lost", "the chamber was silent"}).has_value());
  if (analysed) {
    REQUIRE(runner::analyse_campaign(store, id, parse_campaign(config_text, "x").value(), "0.1.0")
                .has_value());
  }
  return path;
}

std::size_t count(const std::string& text, const std::string& what) {
  std::size_t found = 0;
  for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; ++at) ++found;
  return found;
}

}  // namespace

TEST_CASE("a campaign's report tells conditions, verdicts, models, troubles and provenance",
          "[report]") {
  const TemporaryFolder folder;
  const auto facts = read_campaign_facts(database(folder, true)).value();
  const std::string html = campaign_report(facts, "0.2.0").value();
  CHECK(html.find("<h1>Campaign &lt;b&gt;bold</h1>") != std::string::npos);
  CHECK(count(html, "<figure>") == 1 + 3 * 4);
  CHECK(count(html, "MARGINAL") == 3);
  CHECK(html.find("the chamber left its band &amp; came back") != std::string::npos);
  CHECK(html.find("the chamber was silent") != std::string::npos);
  CHECK(html.find("this report by gyrocal 0.2.0") != std::string::npos);
  CHECK(html.find("SHA-256 over the raw samples used of board a: ") != std::string::npos);
  CHECK(count(html, "<td>improved_gm11</td>") == 3);
}

TEST_CASE("a campaign that still runs is told as far as it got", "[report]") {
  const TemporaryFolder folder;
  const auto facts = read_campaign_facts(database(folder, false)).value();
  const std::string html = campaign_report(facts, "0.2.0").value();
  CHECK(html.find("No model is stored: the campaign has not been analysed.") != std::string::npos);
  CHECK(count(html, "REJECT") == 3);
  CHECK(count(html, "<figure>") == 1 + 3 * 2);
}

TEST_CASE("the verdict is the recommended model's held-out error against the limits", "[report]") {
  AxisFacts axis;
  axis.models.push_back({{}, {}});
  axis.models[0].row.method = "gm11";
  axis.models[0].row.recommended = true;
  axis.models[0].row.loocv_rmse_dps = 0.03;
  using Word = Acceptance::Word;
  CHECK(judge(axis, {0.03, {}}).word == Word::pass);
  CHECK(judge(axis, {0.02, {}}).word == Word::reject);
  CHECK(judge(axis, {0.02, 0.04}).word == Word::marginal);
  CHECK(judge(axis, {}).word == Word::not_judged);
  axis.models[0].row.loocv_rmse_dps = NAN;
  CHECK(judge(axis, {0.03, 0.04}).word == Word::reject);
}

TEST_CASE("a database without a campaign, and one that is none, are refused",
          "[report][bad input]") {
  const TemporaryFolder folder;
  { auto store = Store::open(folder / "empty.db").value(); }
  const auto empty = read_campaign_facts(folder / "empty.db");
  REQUIRE_FALSE(empty.has_value());
  CHECK(empty.error().what == folder / "empty.db" + ": holds no campaign");
  CHECK_FALSE(read_campaign_facts(folder / "none.db").has_value());
}
