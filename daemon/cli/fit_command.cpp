#include <fmt/core.h>

#include <cmath>
#include <memory>

#include "compensation/drift/analysis.h"
#include "config/drift_model/model_file.h"
#include "daemon/cli/command.h"
#include "daemon/cli/drift_table_csv.h"
#include "daemon/cli/outcome.h"

namespace gyrocal::cli {
namespace {

struct FitOptions {
  std::string table;
  int degree = improved_degree_paper;
  SensorIdentity sensor;
  bool as_json = false;
};

std::string shown(double value) {
  return std::isfinite(value) ? fmt::format("{:.4f}", value) : "-";
}

void print_row(const FittedModel& model, bool recommended) {
  fmt::print("{} {:<17}{:>9}{:>11}{:>9}{:>9}{:>10}{:>10}{:>7}", recommended ? '*' : ' ',
             model.method, shown(model.training.rmse_n), shown(model.training.rmse_n_minus_1),
             shown(model.training.mae), shown(model.training.max), shown(model.loocv_rmse_dps),
             shown(model.block_rmse_dps), fmt::format("{:.1f}", model.effective_parameters));
  if (model.grade) {
    fmt::print("  C {:.3f}, P {:.2f}: {}", model.grade->posterior_error_ratio,
               model.grade->small_error_probability, model.grade->grade);
  }
  fmt::print("\n");
}

void print_analysis(const Analysis& analysis) {
  fmt::print("  errors in deg/s      on the data it was fitted to          on data left out\n");
  fmt::print("  {:<17}{:>9}{:>11}{:>9}{:>9}{:>10}{:>10}{:>7}\n", "method", "RMSE n", "RMSE n-1",
             "MAE", "max", "one", "three", "param");
  for (std::size_t i = 0; i < analysis.models.size(); ++i) {
    print_row(analysis.models[i], analysis.recommended == i);
  }
  fmt::print("{}\n", analysis.reason);
}

void print_complaints(const Analysis& analysis) {
  for (const auto& warning : analysis.warnings) fmt::print(stderr, "warning: {}\n", warning);
  for (const auto& model : analysis.models) {
    for (const auto& warning : model.warnings) {
      fmt::print(stderr, "warning: {}: {}\n", model.method, warning);
    }
  }
  for (const auto& refused : analysis.refused) {
    fmt::print(stderr, "not fitted: {}: {}\n", refused.method, to_text(refused.error));
  }
}

int fit(const FitOptions& options) {
  auto measured = read_drift_table(options.table);
  if (!measured) return report(measured.error());
  AnalysisOptions analysis_options;
  analysis_options.improved_degree = options.degree;
  analysis_options.standard_error_dps = std::move(measured->standard_error_dps);
  const auto analysis = analyse(measured->table, analysis_options);
  if (!analysis) {
    Error error = analysis.error();
    error.what = options.table + ": " + error.what;
    return report(error);
  }
  if (options.as_json) {
    auto json = analysis_to_json(*analysis);
    json["sensor"] = identity_to_json(options.sensor);
    fmt::print("{}\n", json.dump());
  } else {
    print_analysis(*analysis);
  }
  print_complaints(*analysis);
  return exit_done;
}

}  // namespace

void add_fit(CLI::App& root, Chosen& chosen) {
  auto* command = root.add_subcommand(
      "fit",
      "Example: gyrocal fit --table drift.csv --json > models.json\n"
      "Fits every model to zero drifts over temperature and says how well each predicts setpoints "
      "it has not seen. The CSV has the columns temperature_c and zero_drift_dps, and "
      "standard_error_dps where known.");
  const auto options = std::make_shared<FitOptions>();
  command->add_option("--table", options->table, "CSV file, or - for standard input")->required();
  command->add_option("--degree", options->degree, "of the improved model's residual polynomial")
      ->check(CLI::Range(0, improved_degree_max))
      ->capture_default_str();
  command->add_option("--board", options->sensor.board, "whose table it is, kept with the model");
  command->add_option("--axis", options->sensor.axis, "x, y or z, kept with the model")
      ->check(CLI::IsMember({"x", "y", "z"}));
  command->add_option("--temperature-scale", options->sensor.temperature_scale,
                      "the thermometer (board, chamber, ...), kept with the model");
  command->add_flag("--json", options->as_json, "print JSON");
  command->callback([options, &chosen] { chosen = [options] { return fit(*options); }; });
}

}  // namespace gyrocal::cli
