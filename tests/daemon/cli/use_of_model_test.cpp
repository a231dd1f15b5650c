// gyrocal compensate and gyrocal firmware on a model that gyrocal fit printed.
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/daemon/cli/run_gyrocal.h"

using namespace gyrocal;

namespace {

const std::string& drift_csv() {
  static const std::string csv = [] {
    std::string text = "temperature_c,zero_drift_dps\n";
    for (int i = 0; i < 13; ++i) {
      const double t = -10 + 5 * i;
      std::ostringstream row;
      row.precision(17);
      row << t << ',' << 4.3 - 0.006 * t + 5e-5 * t * t + 0.01 * (i % 3) << '\n';
      text += row.str();
    }
    return text;
  }();
  return csv;
}

std::string model_file(const std::string& sensor = {}) {
  const auto ran = run_gyrocal("fit --table - --json " + sensor, drift_csv());
  REQUIRE(ran.exit_code == 0);
  return temporary_file("models" + std::to_string(sensor.size()) + ".json", ran.out);
}

}  // namespace

TEST_CASE("compensate takes the drift off a stream and says what is left", "[cli]") {
  const auto ran = run_gyrocal("compensate --method polynomial_2 --model " + model_file(),
                               "t_s,board_c,gyro_z_dps\n0,12.5,4.25\n1,12.6,4.15\n");
  REQUIRE(ran.exit_code == 0);
  std::istringstream out(ran.out);
  std::string line;
  std::getline(out, line);
  CHECK(line == "t_s,board_c,gyro_z_dps,model_drift_dps,compensated_dps");
  std::getline(out, line);
  CHECK(line.starts_with("0,12.5,4.25,4.2"));
  CHECK(ran.err.find("before") != std::string::npos);
  CHECK(ran.err.find("fitted to") == std::string::npos);
}

TEST_CASE("compensate says when the data are those of the fit", "[cli]") {
  const auto file = model_file();
  const auto ran = run_gyrocal("compensate --json --model " + file, drift_csv());
  REQUIRE(ran.exit_code == 0);
  const auto json = nlohmann::json::parse(ran.out);
  CHECK(json["rows"] == 13);
  CHECK(json["rows_of_training"] == 13);
  CHECK(json["after"]["rms_dps"].get<double>() < 0.02);
  CHECK(json["before"]["rms_dps"].get<double>() > 4);
  CHECK(ran.err.find("13 of 13 rows are data this model was fitted to") != std::string::npos);
}

TEST_CASE("compensate refuses rows outside the setpoints unless told", "[cli][bad input]") {
  const auto file = model_file();
  const std::string hot = "temperature_c,rate_dps\n20,4.2\n55,4.2\n";
  const auto refused = run_gyrocal("compensate --model " + file, hot);
  CHECK(refused.exit_code == 2);
  CHECK(refused.out.empty());
  CHECK(refused.err ==
        "gyrocal: standard input line 3, column 1 (temperature_c): 55 degC lies outside the "
        "calibrated -10 to 50 degC\n  advice: leave the row out, or give --extrapolate\n");
  CHECK(run_gyrocal("compensate --extrapolate --model " + file, hot).exit_code == 0);
}

TEST_CASE("models that are none are refused by file and line", "[cli][bad input]") {
  const auto complaint = [](const std::string& content, const std::string& more = {}) {
    const auto path = temporary_file("bad.json", content);
    const auto ran = run_gyrocal("compensate --model " + path + more, drift_csv());
    CHECK(ran.exit_code == 2);
    return ran.err.substr(ran.err.find("bad.json"));
  };
  CHECK(complaint("{\n\n oops").starts_with("bad.json line 3: this is no JSON"));
  CHECK(complaint("[]").starts_with("bad.json: expected an object with \"models\""));
  CHECK(complaint("{\"models\":[]}").starts_with("bad.json recommends no model"));
  CHECK(complaint("{\"method\":\"gm11\",\"parameters\":{\"a\":1}}")
            .starts_with("bad.json: model gm11: parameter \"b\" is missing"));
  CHECK(complaint("{\"method\":\"gm11\",\"parameters\":{\"a\":\"x\"}}")
            .starts_with("bad.json: model parameter \"a\" holds \"x\", expected numbers"));
  const auto unknown =
      run_gyrocal("compensate --method kalman --model " + model_file(), drift_csv());
  CHECK(unknown.exit_code == 2);
  CHECK(unknown.err.find("choose one of: gm11, improved_gm11, least_squares") != std::string::npos);
  const auto mistyped =
      run_gyrocal("compensate --method least_square --model " + model_file(), drift_csv());
  CHECK(mistyped.err.find("is \"least_squares\" meant?") != std::string::npos);
}

TEST_CASE("firmware refuses a model of another board or thermometer", "[cli]") {
  const auto file = model_file("--board 3132333435 --axis z --temperature-scale board");
  const auto ran = [&](const std::string& more) {
    return run_gyrocal("firmware --format c --model " + file + more);
  };
  CHECK(ran("").exit_code == 0);
  CHECK(ran(" --board 3132333435 --axis z --temperature-scale board").exit_code == 0);
  const auto other = ran(" --board 999");
  CHECK(other.exit_code == 1);
  CHECK(other.out.empty());
  CHECK(other.err.find("the model's board is \"3132333435\", asked for is \"999\"") !=
        std::string::npos);
  CHECK(ran(" --axis x").exit_code == 1);
  CHECK(ran(" --temperature-scale chamber").exit_code == 1);
  CHECK(ran(" --format hex").exit_code == 2);
}

TEST_CASE("firmware writes each format and states its loss", "[cli]") {
  const auto file = model_file("--board A --axis z");
  for (const std::string format : {"c", "px4", "ardupilot", "csv", "json"}) {
    const auto ran = run_gyrocal("firmware --model " + file + " --format " + format);
    CHECK(ran.exit_code == 0);
    CHECK(ran.err.find("axis z: read back and evaluated in single precision") != std::string::npos);
    CHECK_FALSE(ran.out.empty());
  }
  const auto unstated = run_gyrocal("firmware --format c --model " + model_file());
  CHECK(unstated.exit_code == 0);
  CHECK(unstated.err.starts_with("warning: the model does not state its axis, z is written"));
  CHECK(run_gyrocal("firmware --format c --axis z --model " + model_file()).exit_code == 0);
  CHECK(run_gyrocal("firmware --format c --model " + file + " -o /nonexistent/x.h").exit_code == 1);
}
