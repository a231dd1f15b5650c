#include <fmt/core.h>

#include <memory>

#include "config/drift_model/model_file.h"
#include "daemon/cli/analysis_text.h"
#include "daemon/cli/command.h"
#include "daemon/cli/drift_table_csv.h"
#include "daemon/cli/outcome.h"
#include "daemon/cli/stored_drift.h"

namespace gyrocal::cli {
namespace {

using Json = nlohmann::ordered_json;

struct FitOptions {
  std::string table;
  std::string database;
  int degree = improved_degree_paper;
  SensorIdentity sensor;
  bool as_json = false;
};

/// One table to fit, and whose it is.
struct FitInput {
  std::string source;  ///< for messages
  SensorIdentity sensor;
  MeasuredTable measured;
};

Result<std::vector<FitInput>> inputs_from_table(const FitOptions& options) {
  auto measured = read_drift_table(options.table);
  if (!measured) return tl::unexpected(std::move(measured.error()));
  return std::vector<FitInput>{{options.table == "-" ? "standard input" : options.table,
                                options.sensor, std::move(*measured)}};
}

Result<std::vector<FitInput>> inputs_from_database(const FitOptions& options) {
  const auto store = Store::open_read_only(options.database);
  if (!store) return tl::unexpected(store.error());
  const auto sensors = sensors_of(*store, options.sensor.board, options.sensor.axis);
  if (!sensors) return tl::unexpected(sensors.error());
  const auto& asked = options.sensor.temperature_scale;
  const std::string scale = asked.empty() ? "setpoint" : asked;
  std::vector<FitInput> inputs;
  for (const StoredSensor& sensor : *sensors) {
    auto measured = stored_table(*store, sensor, scale);
    if (!measured) return tl::unexpected(std::move(measured.error()));
    inputs.push_back({fmt::format("{}: board '{}', axis {}", options.database, sensor.board.name,
                                  letter(sensor.axis)),
                      identity_of(sensor, scale), std::move(*measured)});
  }
  return inputs;
}

Result<Analysis> analysed(const FitInput& input, int degree) {
  AnalysisOptions options;
  options.improved_degree = degree;
  options.standard_error_dps = input.measured.standard_error_dps;
  auto analysis = analyse(input.measured.table, options);
  if (!analysis) analysis.error().what = input.source + ": " + analysis.error().what;
  return analysis;
}

Json analysis_json(const Analysis& analysis, const SensorIdentity& sensor) {
  Json json = analysis_to_json(analysis);
  json["sensor"] = identity_to_json(sensor);
  return json;
}

int fit(const FitOptions& options) {
  if (options.table.empty() == options.database.empty()) {
    return report({Errc::bad_input, "give either --table or --db", "see gyrocal fit --help"});
  }
  const auto inputs =
      options.table.empty() ? inputs_from_database(options) : inputs_from_table(options);
  if (!inputs) return report(inputs.error());
  Json all = Json::array();
  for (const FitInput& input : *inputs) {
    const auto analysis = analysed(input, options.degree);
    if (!analysis) return report(analysis.error());
    if (options.as_json) {
      all.push_back(analysis_json(*analysis, input.sensor));
    } else {
      if (inputs->size() > 1) fmt::print("{}\n", input.source);
      print_analysis(*analysis);
      if (inputs->size() > 1) fmt::print("\n");
    }
    print_complaints(*analysis);
  }
  if (options.as_json) {
    fmt::print("{}\n", (all.size() == 1 ? all.front() : Json{{"sensors", all}}).dump());
  }
  return exit_done;
}

}  // namespace

void add_fit(Command& root, Chosen& chosen) {
  auto* command = root.add_subcommand(
      "fit",
      "Example: gyrocal fit --table drift.csv --json > models.json\n"
      "Fits every model to zero drifts over temperature and says how well each predicts setpoints "
      "it has not seen. The CSV has the columns temperature_c and zero_drift_dps, and "
      "standard_error_dps where known; from a database come the zero drifts of the latest "
      "campaign.");
  const auto options = std::make_shared<FitOptions>();
  command->add_option("--table", options->table, "CSV file, or - for standard input");
  command->add_option("--db", options->database, "a campaign's database");
  command->add_option("--degree", options->degree, "of the improved model's residual polynomial")
      ->within(0, improved_degree_max)
      ->capture_default_str();
  command->add_option("--board", options->sensor.board,
                      "of a database: only this one; of a table: kept with the model");
  command->add_option("--axis", options->sensor.axis, "x, y or z, likewise")
      ->one_of({"x", "y", "z"});
  command->add_option("--temperature-scale", options->sensor.temperature_scale,
                      "of a database: setpoint (default), chamber or board; of a table: kept with "
                      "the model");
  command->add_flag("--json", options->as_json, "print JSON");
  command->callback([options, &chosen] { chosen = [options] { return fit(*options); }; });
}

}  // namespace gyrocal::cli
