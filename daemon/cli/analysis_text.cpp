#include "daemon/cli/analysis_text.h"

#include <fmt/core.h>

#include <cmath>

namespace gyrocal::cli {
namespace {

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

}  // namespace

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

}  // namespace gyrocal::cli
