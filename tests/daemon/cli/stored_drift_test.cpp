// gyrocal fit, compensate and firmware on a database.
#include <algorithm>
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "compensation/drift/analysis.h"
#include "compensation/drift/paper.h"
#include "daemon/runner/analysis.h"
#include "schema/store.h"
#include "tests/daemon/cli/run_gyrocal.h"

using namespace gyrocal;

namespace {

ModelInsert insert_of(const FittedModel& model, BoardId board, Axis axis) {
  ModelInsert insert = runner::model_row(model, board, axis);
  insert.dwells_sha256 = "none";
  return insert;
}

/// The paper's Table 1 as the y and z axes of two boards, y 1 deg/s higher; the board's sensor 2 K
/// above the setpoint, no chamber temperature.
std::string paper_database(const std::string& name) {
  const auto path = temporary_file(name, "");
  std::remove(path.c_str());
  auto store = Store::open(path).value();
  const auto& table = paper_table_1();
  std::vector<SetpointRow> setpoints;
  for (std::size_t i = 0; i < 25; ++i) {
    setpoints.push_back({static_cast<int>(i), {table.temperature_c[i]}});
  }
  CampaignRow campaign;
  campaign.name = "paper";
  campaign.software_version = "test";
  campaign.samples_per_setpoint = 1;
  campaign.sample_rate_hz = 50;
  campaign.state = "finished";
  const auto id = store.begin_campaign(campaign, setpoints).value();
  std::vector<DwellDriftInsert> drifts;
  std::vector<ModelInsert> models;
  const std::vector<BoardSample> samples{BoardSample{0, 1, {0, 17, 17}, {}}};
  for (const std::string board_name : {"first", "second"}) {
    BoardRow row;
    row.name = board_name;
    row.device = "/dev/" + board_name;
    row.mcu_id = board_name == "first" ? "AAAA" : "BBBB";
    row.lsb_per_dps = {4.13, 4.13, 4.13};
    row.measured = {false, true, true};
    const auto board = store.add_board(id, row).value();
    for (std::size_t i = 0; i < 25; ++i) {
      DwellRow dwell;
      dwell.board = board;
      dwell.ordinal = static_cast<int>(i);
      dwell.t_start_ns = static_cast<std::int64_t>(i) * 1'000'000'000;
      dwell.t_end_ns = dwell.t_start_ns + 1'000'000;
      dwell.board_mean_c = table.temperature_c[i] + 2;
      const DwellWithSamples group[] = {{dwell, samples}};
      const auto dwell_id = store.add_group(id, group).value().front();
      drifts.push_back({dwell_id, Axis::z, table.zero_drift_dps[i], 1.3, table.zero_drift_dps[i],
                        0.25, missing});
      drifts.push_back({dwell_id, Axis::y, table.zero_drift_dps[i] + 1, 1.3,
                        table.zero_drift_dps[i] + 1, 0.25, missing});
    }
    const auto analysis = analyse(table).value();
    for (const auto& model : analysis.models) models.push_back(insert_of(model, board, Axis::z));
    models[models.size() - 9 + *analysis.recommended].recommended = true;
  }
  REQUIRE(store.add_analysis(id, {R"({"wavelet":"db4"})", "test"}, drifts, models).has_value());
  return path;
}

}  // namespace

TEST_CASE("fit on a database fits what was measured", "[cli][database]") {
  const auto path = paper_database("fit.db");
  const auto one = run_gyrocal("fit --json --board first --axis z --db " + path);
  REQUIRE(one.exit_code == 0);
  const auto json = nlohmann::json::parse(one.out);
  CHECK(json["sensor"]["board"] == "AAAA");
  CHECK(json["sensor"]["temperature_scale"] == "setpoint");
  CHECK(json["models"][0]["parameters"]["a"].get<double>() == Approx(0.0033609101469321396));
  CHECK(json["recommended"] == "smoothing_spline");

  const auto all = run_gyrocal("fit --json --db " + path);
  REQUIRE(all.exit_code == 0);
  CHECK(nlohmann::json::parse(all.out)["sensors"].size() == 4);  // two boards, y and z

  const auto board =
      run_gyrocal("fit --json --board BBBB --axis z --temperature-scale board --db " + path);
  REQUIRE(board.exit_code == 0);
  CHECK(nlohmann::json::parse(board.out)["models"][0]["setpoints_c"][0] == -8);
}

TEST_CASE("what a database does not have is said by name", "[cli][database][bad input]") {
  const auto path = paper_database("bad.db");
  const auto unknown = run_gyrocal("fit --board third --db " + path);
  CHECK(unknown.exit_code == 2);
  CHECK(unknown.err.find("boards: first, second") != std::string::npos);
  CHECK(run_gyrocal("fit --board secnod --db " + path).err.find("is \"second\" meant?") !=
        std::string::npos);
  CHECK(run_gyrocal("fit --board first --temperature-scale bord --db " + path)
            .err.find("is \"board\" meant?") != std::string::npos);
  const auto axis = run_gyrocal("fit --board first --axis x --db " + path);
  CHECK(axis.exit_code == 2);
  const auto chamber =
      run_gyrocal("fit --board first --axis z --temperature-scale chamber --db " + path);
  CHECK(chamber.exit_code == 2);
  CHECK(
      chamber.err.find("board 'first', axis z: the dwell at -10 degC has no chamber temperature") !=
      std::string::npos);
  CHECK(run_gyrocal("fit --temperature-scale air --db " + path).exit_code == 2);
  CHECK(run_gyrocal("fit --db /nonexistent/x.db").exit_code != 0);
  CHECK(run_gyrocal("fit --table - --db " + path).exit_code == 2);
  CHECK(run_gyrocal("firmware --format c --db " + path).exit_code == 2);  // two boards
  const auto no_model = run_gyrocal("firmware --format c --board first --axis y --db " + path);
  CHECK(no_model.exit_code == 2);
  CHECK(no_model.err.find("board 'first', axis y: no model is stored") != std::string::npos);
}

TEST_CASE("compensate on a database says that its own model was fitted to it", "[cli][database]") {
  const auto path = paper_database("compensate.db");
  const auto own = run_gyrocal("compensate --json --board first --axis z --db " + path);
  REQUIRE(own.exit_code == 0);
  const auto json = nlohmann::json::parse(own.out);
  CHECK(json["method"] == "smoothing_spline");
  CHECK(json["rows_of_training"] == 25);
  CHECK(own.err.find("25 of 25 rows are data this model was fitted to") != std::string::npos);
  CHECK(json["after"]["rms_dps"].get<double>() == Approx(0.0254).margin(1e-4));

  const auto model =
      temporary_file("z.json", run_gyrocal("fit --json --board first --axis z --db " + path).out);
  CHECK(run_gyrocal("compensate --board first --axis z --db " + path + " --model " + model)
            .exit_code == 0);
  const auto other =
      run_gyrocal("compensate --board second --axis z --db " + path + " --model " + model);
  CHECK(other.exit_code == 1);
  CHECK(other.out.empty());
}

TEST_CASE("compensate on a database's raw samples takes the model off each one",
          "[cli][database]") {
  const auto path = paper_database("compensate_samples.db");
  const auto rows = run_gyrocal("compensate --samples --board first --axis z --db " + path);
  REQUIRE(rows.exit_code == 0);
  // One sample of 17 LSB a dwell: 17 / 4.13 deg/s.
  CHECK(
      rows.out.starts_with("t_s,setpoint_c,temperature_c,rate_dps,model_drift_dps,compensated_dps\n"
                           "0.000000,-10,-10,4.11622276,4.3"));
  CHECK(std::count(rows.out.begin(), rows.out.end(), '\n') == 26);
  CHECK(rows.err.find("25 of 25 setpoints are data this model was fitted to") != std::string::npos);
  const auto report =
      run_gyrocal("compensate --json --samples --board first --axis z --db " + path);
  const auto json = nlohmann::json::parse(report.out);
  CHECK(json["rows"] == 25);
  CHECK(json["setpoints_of_training"] == 25);
  CHECK(json["before"]["mean_dps"].get<double>() == Approx(17 / 4.13));
  CHECK(json["before"]["standard_deviation_dps"].get<double>() == Approx(0).margin(1e-9));
  CHECK(json["after"]["standard_deviation_dps"].get<double>() > 0.05);

  const auto alone = run_gyrocal("compensate --samples --model x.json");
  CHECK(alone.exit_code == 2);
  CHECK(alone.err.find("--samples goes with --db") != std::string::npos);
}

TEST_CASE("firmware from a database names its board and keeps to its thermometer",
          "[cli][database]") {
  const auto path = paper_database("firmware.db");
  const auto header = run_gyrocal("firmware --format c --board first --axis z --db " + path);
  REQUIRE(header.exit_code == 0);
  CHECK(header.out.find("#define GYROCAL_BOARD \"AAAA\"") != std::string::npos);
  CHECK(header.out.find("#define GYROCAL_TEMPERATURE_SCALE \"setpoint\"") != std::string::npos);
  const auto scale = run_gyrocal(
      "firmware --format c --board first --axis z --temperature-scale board --db " + path);
  CHECK(scale.exit_code == 1);
  CHECK(scale.err.find("the model's temperature scale is \"setpoint\", asked for is \"board\"") !=
        std::string::npos);
}
