#include "daemon/cli/paper_examined.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "compensation/drift/analysis.h"
#include "compensation/drift/paper.h"
#include "daemon/cli/outcome.h"

namespace gyrocal::cli {
namespace {

constexpr int dwell_samples = 3000;

void print_header(const char* title) {
  fmt::print("{:<34}{:>10}{:>10}{:>10}{:>10}\n", title, "RMSE n-1", "MAE", "one out", "three out");
}

void print_row(const std::string& name, const FittedModel& model) {
  fmt::print("{:<34}{:>10.4f}{:>10.4f}{:>10.4f}{:>10.4f}\n", name, model.training.rmse_n_minus_1,
             model.training.mae, model.loocv_rmse_dps, model.block_rmse_dps);
}

Result<Analysis> analysed(const DriftTable& table, std::vector<Method> methods, int degree) {
  AnalysisOptions options;
  options.methods = std::move(methods);
  options.improved_degree = degree;
  return analyse(table, options);
}

/// The same setpoints visited from hot to cold: on the axis -T they rise again.
DriftTable reversed(DriftTable table) {
  std::reverse(table.temperature_c.begin(), table.temperature_c.end());
  std::reverse(table.zero_drift_dps.begin(), table.zero_drift_dps.end());
  for (double& t : table.temperature_c) t = -t;
  return table;
}

Result<void> print_degrees() {
  print_header("degree of the residual polynomial");
  for (int degree = 0; degree <= improved_degree_max; ++degree) {
    const auto analysis = analysed(paper_table_1(), {Method::improved_gm11}, degree);
    if (!analysis) return tl::unexpected(analysis.error());
    print_row(fmt::format("  improved_gm11, degree {}", degree), analysis->models.front());
  }
  return {};
}

Result<void> print_orders() {
  const std::vector<Method> methods{Method::gm11, Method::improved_gm11, Method::least_squares};
  print_header("order of the setpoints");
  for (const bool downwards : {false, true}) {
    const auto table = downwards ? reversed(paper_table_1()) : paper_table_1();
    const auto analysis = analysed(table, methods, improved_degree_paper);
    if (!analysis) return tl::unexpected(analysis.error());
    for (const auto& model : analysis->models) {
      print_row(fmt::format("  {}, {}", model.method, downwards ? "hot to cold" : "cold to hot"),
                model);
    }
  }
  return {};
}

Result<void> print_references() {
  const auto analysis = analyse(paper_table_1());
  if (!analysis) return tl::unexpected(analysis.error());
  print_header("every method");
  for (const auto& model : analysis->models) print_row("  " + model.method, model);
  fmt::print("{}\n", analysis->reason);
  return {};
}

void print_constants() {
  fmt::print(
      "noise of a zero drift: if a dwell's noise is white, {:.4f} / sqrt({}) = {:.4f} deg/s\n",
      paper_raw_deviation_dps, dwell_samples, paper_raw_deviation_dps / std::sqrt(dwell_samples));
  const double counts_per_dps = 3.33 * 4096 / 3300;
  const double lowest = *std::min_element(paper_table_1().zero_drift_dps.begin(),
                                          paper_table_1().zero_drift_dps.end());
  fmt::print(
      "4.13 is counts: 3.33 mV/(deg/s) * 4096 / 3300 mV = {:.3f} LSB/(deg/s); one count is "
      "{:.4f} deg/s.\nTaken as millivolts, {} deg/s would be {:.2f} deg/s.\n",
      counts_per_dps, 1 / 4.13, lowest, lowest * 4.13 / 3.33);
}

}  // namespace

int report_paper_examined() {
  for (const auto print : {print_degrees, print_orders, print_references}) {
    if (const auto done = print(); !done) return report(done.error());
    fmt::print("\n");
  }
  print_constants();
  return exit_done;
}

int print_paper_table_1() {
  fmt::print("temperature_c,zero_drift_dps\n");
  const auto& table = paper_table_1();
  for (std::size_t i = 0; i < table.temperature_c.size(); ++i) {
    fmt::print("{},{:.4f}\n", table.temperature_c[i], table.zero_drift_dps[i]);
  }
  return exit_done;
}

}  // namespace gyrocal::cli
