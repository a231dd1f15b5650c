#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>

#include "compensation/drift/analysis.h"
#include "compensation/drift/paper.h"
#include "daemon/cli/command.h"
#include "daemon/cli/outcome.h"
#include "daemon/cli/paper_dwell_deviation.h"
#include "daemon/cli/paper_examined.h"

namespace gyrocal::cli {
namespace {

using Json = nlohmann::ordered_json;

struct PaperOptions {
  bool dwell_deviation = false;
  bool examine = false;
  bool table_1 = false;
  std::uint64_t seed = 1;
  bool as_json = false;
};

/// One row of Table 2 beside our own figures, rounded to the four digits the paper prints.
struct ComparedRow {
  PaperFigures paper;
  const FittedModel* ours;
  double rmse_dps;  ///< with the divisor the paper used for this row

  [[nodiscard]] static bool same_digits(double ours, double printed) {
    return std::lround(ours * 1e4) == std::lround(printed * 1e4);
  }
  [[nodiscard]] bool rmse_agrees() const { return same_digits(rmse_dps, paper.rmse_printed_dps); }
  [[nodiscard]] bool mae_agrees() const {
    return same_digits(ours->training.mae, paper.mae_printed_dps);
  }
};

std::vector<ComparedRow> compared(const Analysis& analysis) {
  std::vector<ComparedRow> rows;
  for (const auto& figures : paper_table_2) {
    const auto ours = std::find_if(analysis.models.begin(), analysis.models.end(),
                                   [&](const auto& m) { return m.method == figures.method; });
    if (ours == analysis.models.end()) continue;
    rows.push_back(
        {figures, &*ours,
         figures.rmse_divides_by_n ? ours->training.rmse_n : ours->training.rmse_n_minus_1});
  }
  return rows;
}

/// A printed figure that is not ours but is another one of ours: the two changed places.
std::vector<std::string> swapped_figures(const std::vector<ComparedRow>& rows) {
  std::vector<std::string> sentences;
  for (const auto& a : rows) {
    for (const auto& b : rows) {
      if (a.mae_agrees() || b.rmse_agrees()) continue;
      if (ComparedRow::same_digits(a.ours->training.mae, b.paper.rmse_printed_dps) &&
          ComparedRow::same_digits(b.rmse_dps, a.paper.mae_printed_dps)) {
        sentences.push_back(fmt::format(
            "Table 2 as printed has two figures swapped: {:.4f} stands as the MAE of \"{}\" and is "
            "the RMSE of \"{}\"; {:.4f} stands there and is the MAE.",
            a.paper.mae_printed_dps, a.paper.title, b.paper.title, b.paper.rmse_printed_dps));
      }
    }
  }
  return sentences;
}

void print_text(const std::vector<ComparedRow>& rows, const std::vector<std::string>& swapped) {
  fmt::print("Table 2 of the paper from its Table 1 (25 setpoints, -10 to 50 degC), in deg/s\n\n");
  fmt::print("{:<26}{:>9}{:>9}   {:>9}{:>9}   {:>9}\n", "", "RMSE", "MAE", "printed", "printed",
             "left out");
  fmt::print("{:<26}{:>9}{:>9}   {:>9}{:>9}   {:>9}\n", "", "", "", "RMSE", "MAE", "RMSE");
  for (const auto& row : rows) {
    fmt::print("{:<26}{:>9.4f}{:>9.4f}   {:>8.4f}{}{:>8.4f}{}   {:>9.4f}\n", row.paper.title,
               row.rmse_dps, row.ours->training.mae, row.paper.rmse_printed_dps,
               row.rmse_agrees() ? ' ' : '!', row.paper.mae_printed_dps,
               row.mae_agrees() ? ' ' : '!', row.ours->loocv_rmse_dps);
  }
  fmt::print("\n");
  for (const auto& sentence : swapped) fmt::print("{}\n", sentence);
  fmt::print(
      "The text of section 5.5 has these two the right way round (its \"0.384\" lost a zero).\n");
  fmt::print("Divisors are mixed: n under the grey RMSE, n-1 under the other two:\n");
  for (const auto& row : rows) {
    fmt::print("  {:<24} n {:.4f}, n-1 {:.4f}; the paper's figure divides by {}\n", row.paper.title,
               row.ours->training.rmse_n, row.ours->training.rmse_n_minus_1,
               row.paper.rmse_divides_by_n ? "n" : "n-1");
  }
  fmt::print(
      "All printed figures are of the data the models were fitted to; \"left out\" is each "
      "model's leave-one-out error.\n");
}

Json comparison_json(const std::vector<ComparedRow>& rows,
                     const std::vector<std::string>& swapped) {
  Json json;
  json["rows"] = Json::array();
  for (const auto& row : rows) {
    json["rows"].push_back({{"method", row.paper.method},
                            {"title", row.paper.title},
                            {"rmse", row.rmse_dps},
                            {"rmse_n", row.ours->training.rmse_n},
                            {"rmse_n_minus_1", row.ours->training.rmse_n_minus_1},
                            {"mae", row.ours->training.mae},
                            {"loocv_rmse", row.ours->loocv_rmse_dps},
                            {"printed_rmse", row.paper.rmse_printed_dps},
                            {"printed_mae", row.paper.mae_printed_dps},
                            {"text_rmse", row.paper.rmse_text_dps},
                            {"text_mae", row.paper.mae_text_dps},
                            {"printed_rmse_agrees", row.rmse_agrees()},
                            {"printed_mae_agrees", row.mae_agrees()},
                            {"rmse_divisor", row.paper.rmse_divides_by_n ? "n" : "n-1"},
                            {"fitted", row.ours->fitted_dps}});
  }
  json["swapped"] = swapped;
  return json;
}

int table_2(bool as_json) {
  AnalysisOptions options;
  options.methods = {Method::gm11, Method::least_squares, Method::improved_gm11};
  const auto analysis = analyse(paper_table_1(), options);
  if (!analysis) return report(analysis.error());
  const auto rows = compared(*analysis);
  const auto swapped = swapped_figures(rows);
  if (as_json) {
    fmt::print("{}\n", comparison_json(rows, swapped).dump());
  } else {
    print_text(rows, swapped);
  }
  return exit_done;
}

int show(const PaperOptions& options) {
  if (options.dwell_deviation) return report_dwell_deviation(options.seed, options.as_json);
  if (options.examine) return report_paper_examined();
  if (options.table_1) return print_paper_table_1();
  return table_2(options.as_json);
}

}  // namespace

void add_paper(Command& root, Chosen& chosen) {
  auto* command = root.add_subcommand("paper",
                                      "Example: gyrocal paper --dwell-deviation\n"
                                      "Computes the paper's Table 2 from its Table 1, beside the "
                                      "figures printed there; or what its "
                                      "filter leaves of a dwell's deviation.");
  const auto options = std::make_shared<PaperOptions>();
  auto* dwell = command->add_flag("--dwell-deviation", options->dwell_deviation,
                                  "1.3102 to 0.2488 deg/s, on simulated dwells");
  command->add_option("--seed", options->seed, "of the simulated dwells")
      ->needs(dwell)
      ->capture_default_str();
  command->add_flag("--json", options->as_json, "print JSON");
  auto* examine = command->add_flag("--examine", options->examine,
                                    "what the paper leaves open or gets wrong, with its numbers");
  auto* table = command->add_flag("--table-1", options->table_1, "Table 1 as CSV, for gyrocal fit");
  dwell->excludes(examine)->excludes(table);
  examine->excludes(table);
  command->callback([options, &chosen] { chosen = [options] { return show(*options); }; });
}

}  // namespace gyrocal::cli
