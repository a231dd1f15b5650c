#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "compensation/drift/paper.h"
#include "tests/daemon/cli/run_gyrocal.h"

using namespace gyrocal;

namespace {

std::string paper_csv(const std::string& line_end = "\n") {
  std::string csv = "temperature_c,zero_drift_dps" + line_end;
  const auto& table = paper_table_1();
  for (std::size_t i = 0; i < table.temperature_c.size(); ++i) {
    csv += nlohmann::json(table.temperature_c[i]).dump() + "," +
           nlohmann::json(table.zero_drift_dps[i]).dump() + line_end;
  }
  return csv;
}

/// The models of a table given on standard input.
nlohmann::json models_of(const std::string& csv) {
  const auto ran = run_gyrocal("fit --table - --json", csv);
  REQUIRE(ran.exit_code == 0);
  return nlohmann::json::parse(ran.out)["models"];
}

std::string complaint_about(const std::string& csv) {
  const auto ran = run_gyrocal("fit --table - --json", csv);
  CHECK(ran.exit_code == 2);
  CHECK(ran.out.empty());
  return ran.err;
}

}  // namespace

TEST_CASE("gyrocal fit prints every model in the agreed shape", "[cli]") {
  const auto models = models_of(paper_csv());
  std::vector<std::string> methods;
  for (const auto& model : models) {
    methods.push_back(model["method"]);
    CHECK(model["parameters"].is_object());
    CHECK(model["fitted"].size() == 25);
    for (const char* key : {"rmse_n", "rmse_n_minus_1", "mae", "max", "loocv_rmse"}) {
      CHECK(model[key].get<double>() > 0);
    }
  }
  CHECK(methods == std::vector<std::string>{"gm11", "improved_gm11", "least_squares",
                                            "polynomial_1", "polynomial_2", "polynomial_3",
                                            "polynomial_4", "polynomial_5", "smoothing_spline"});
  CHECK(models[0]["parameters"]["a"].get<double>() == Approx(0.0033609101469321396));
  CHECK(models[0]["parameters"]["b"].get<double>() == Approx(4.3434014649183235));
}

TEST_CASE("byte-order mark, CRLF, blanks, blank lines and other columns change nothing", "[cli]") {
  const auto plain = models_of(paper_csv());
  CHECK(models_of("\xEF\xBB\xBF" + paper_csv("\r\n")) == plain);
  CHECK(models_of(paper_csv("\n\n")) == plain);
  CHECK(models_of(paper_csv(" \n")) == plain);
  const auto& table = paper_table_1();
  std::string reordered = "dwell, zero_drift_dps , temperature_c,note\n";
  for (std::size_t i = 0; i < table.temperature_c.size(); ++i) {
    const double t = table.temperature_c[i];
    reordered += std::to_string(i) + ", +" + nlohmann::json(table.zero_drift_dps[i]).dump() + ", " +
                 (t > 0 ? "+" : "") + nlohmann::json(t).dump() + ",free text\n";
  }
  CHECK(models_of(reordered) == plain);
}

TEST_CASE("a table that cannot be read names file, line, column and what was expected",
          "[cli][bad input]") {
  const std::string header = "temperature_c,zero_drift_dps\n";
  CHECK(complaint_about("") ==
        "gyrocal: standard input line 1: the file is empty\n"
        "  advice: expected a header row of column names, then rows of numbers\n");
  CHECK(complaint_about(header) ==
        "gyrocal: standard input line 2: there is no row below the header\n"
        "  advice: expected rows of numbers\n");
  CHECK(complaint_about("temperature,zero_drift_dps\n1,2\n") ==
        "gyrocal: standard input line 1: no column \"temperature_c\"; the header holds: "
        "temperature, zero_drift_dps\n  advice: name the column temperature_c\n");
  CHECK(complaint_about(header + "1,4.1\n2,about four\n") ==
        "gyrocal: standard input line 3, column 2 (zero_drift_dps): \"about four\" is no number\n"
        "  advice: expected a decimal number such as 4.3839\n");
  CHECK(complaint_about(header + "1,4.1\n2,\n") ==
        "gyrocal: standard input line 3, column 2 (zero_drift_dps): \"\" is no number\n"
        "  advice: expected a decimal number such as 4.3839\n");
  CHECK(complaint_about(header + "1,4.1\n2,nan\n") ==
        "gyrocal: standard input line 3, column 2 (zero_drift_dps): \"nan\"\n"
        "  advice: expected a finite number\n");
  CHECK(complaint_about(header + "1,4.1\n2,inf\n").find("line 3, column 2") != std::string::npos);
  CHECK(complaint_about(header + "1,4.1\n2,1e999\n").find("line 3, column 2") != std::string::npos);
  CHECK(complaint_about(header + "1,4.1,\n") ==
        "gyrocal: standard input line 2, column 3: 3 fields, expected 2 "
        "(temperature_c,zero_drift_dps)\n  advice: remove the trailing comma or the extra field\n");
  CHECK(complaint_about("temperature_c,zero_drift_dps,\n1,4.1,\n") ==
        "gyrocal: standard input line 1, column 3: the header has no name here\n"
        "  advice: remove the trailing comma, or name the column\n");
  CHECK(complaint_about(header + "1,4.1\n\n2\n").find("line 4, column 2: 1 fields") !=
        std::string::npos);
  CHECK(complaint_about(header + "1,4.1\n5,4.2\n5,4.3\n") ==
        "gyrocal: standard input line 4, column 1 (temperature_c): 5 degC stands here again "
        "(first in line 3)\n  advice: give each temperature once: average its rows or drop one\n");
  CHECK(complaint_about(header + "1,4.1\n9,4.2\n5,4.3\n") ==
        "gyrocal: standard input line 4, column 1 (temperature_c): 5 degC follows 9 degC\n"
        "  advice: expected strictly rising temperatures: sort the rows by temperature_c\n");
  CHECK(complaint_about(header + "1,4.1\n").find("needs at least 2 setpoints, got 1") !=
        std::string::npos);
  CHECK(run_gyrocal("fit --table /nonexistent/drift.csv").exit_code == 2);
  CHECK(run_gyrocal("fit --table /").exit_code == 2);
  CHECK(run_gyrocal("fit").exit_code == 2);
  CHECK(run_gyrocal("fit --table - --degree 6", paper_csv()).exit_code == 2);
}

TEST_CASE("a table of three setpoints is fitted by what three points carry", "[cli]") {
  const auto ran =
      run_gyrocal("fit --table - --json", "temperature_c,zero_drift_dps\n0,4.1\n10,4.2\n20,4.25\n");
  REQUIRE(ran.exit_code == 0);
  const auto json = nlohmann::json::parse(ran.out);
  CHECK(json["models"].size() == 2);  // polynomial_1 and polynomial_2
  CHECK(json["models"][1]["loocv_rmse"].is_null());
  CHECK(json["refused"][0]["method"] == "gm11");
  CHECK(json["refused"][0]["why"] == "GM(1,1) needs at least 4 zero drifts, got 3");
}
