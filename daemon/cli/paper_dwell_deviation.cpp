#include "daemon/cli/paper_dwell_deviation.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

#include "compensation/drift/dwell_deviation.h"
#include "compensation/drift/paper.h"
#include "daemon/cli/outcome.h"

namespace gyrocal::cli {
namespace {

using Json = nlohmann::ordered_json;

/// The filtered deviation of the simulated dwells at one level.
struct LevelDeviation {
  int level = 0;
  double raw_dps = 0;       ///< pooled over the dwells
  double filtered_dps = 0;  ///< pooled over the dwells
  double lowest_dps = 0, highest_dps = 0;
  double mean_moved_max_dps = 0;
};

LevelDeviation pooled(int level, const std::vector<DwellDeviation>& dwells) {
  LevelDeviation sum{level, 0, 0, dwells.front().filtered_dps, dwells.front().filtered_dps};
  for (const auto& dwell : dwells) {
    sum.raw_dps += dwell.raw_dps * dwell.raw_dps;
    sum.filtered_dps += dwell.filtered_dps * dwell.filtered_dps;
    sum.lowest_dps = std::min(sum.lowest_dps, dwell.filtered_dps);
    sum.highest_dps = std::max(sum.highest_dps, dwell.filtered_dps);
    sum.mean_moved_max_dps = std::max(sum.mean_moved_max_dps, dwell.mean_moved_dps);
  }
  const auto n = static_cast<double>(dwells.size());
  sum.raw_dps = std::sqrt(sum.raw_dps / n);
  sum.filtered_dps = std::sqrt(sum.filtered_dps / n);
  return sum;
}

Result<std::vector<LevelDeviation>> levels_of(const WhiteDwells& dwells) {
  constexpr int levels = 7;
  auto settings = default_denoise_settings();
  std::vector<LevelDeviation> rows;
  for (int level = 1; level <= levels; ++level) {
    settings.wavelet.level = level;
    const auto deviations = dwell_deviations(dwells, settings);
    if (!deviations) return tl::unexpected(deviations.error());
    rows.push_back(pooled(level, *deviations));
  }
  return rows;
}

const LevelDeviation& nearest_to_paper(const std::vector<LevelDeviation>& rows) {
  return *std::min_element(rows.begin(), rows.end(), [](const auto& a, const auto& b) {
    return std::abs(std::log(a.filtered_dps / paper_filtered_deviation_dps)) <
           std::abs(std::log(b.filtered_dps / paper_filtered_deviation_dps));
  });
}

void print_levels(const WhiteDwells& dwells, const std::vector<LevelDeviation>& rows) {
  const LevelDeviation& nearest = nearest_to_paper(rows);
  fmt::print(
      "{} simulated dwells of {} samples: white noise, whole counts at {} LSB/(deg/s), seed {}\n"
      "db4, symmetric, approximation alone; standard deviations in deg/s\n\n"
      "{:>5}{:>10}{:>10}{:>24}{:>20}\n",
      dwells.dwells, dwells.samples, dwells.lsb_per_dps, dwells.seed, "level", "raw", "filtered",
      "lowest to highest dwell", "raw / sqrt(2^level)");
  for (const auto& row : rows) {
    fmt::print("{:>5}{:>10.4f}{:>10.4f}{:>15.4f} to {:.4f}{:>20.4f}{}\n", row.level, row.raw_dps,
               row.filtered_dps, row.lowest_dps, row.highest_dps,
               row.raw_dps / std::sqrt(std::pow(2, row.level)),
               row.level == nearest.level ? "  <- nearest to the paper" : "");
  }
  fmt::print(
      "\nThe paper: {:.4f} before, {:.4f} after; no level named. Level {} leaves {:.4f} of white "
      "noise, single dwells {:.4f} to {:.4f}.\nIt moves a dwell's mean by at most {:.4f}: the zero "
      "drift is "
      "that of a plain mean.\n",
      paper_raw_deviation_dps, paper_filtered_deviation_dps, nearest.level, nearest.filtered_dps,
      nearest.lowest_dps, nearest.highest_dps, nearest.mean_moved_max_dps);
}

}  // namespace

int report_dwell_deviation(std::uint64_t seed, bool as_json) {
  WhiteDwells dwells;
  dwells.deviation_dps = paper_raw_deviation_dps;
  dwells.seed = seed;
  const auto rows = levels_of(dwells);
  if (!rows) return report(rows.error());
  if (!as_json) {
    print_levels(dwells, *rows);
    return exit_done;
  }
  Json json{
      {"dwells", dwells.dwells},
      {"samples", dwells.samples},
      {"seed", seed},
      {"paper",
       {{"raw_dps", paper_raw_deviation_dps}, {"filtered_dps", paper_filtered_deviation_dps}}},
      {"nearest_level", nearest_to_paper(*rows).level},
      {"levels", Json::array()}};
  for (const auto& row : *rows) {
    json["levels"].push_back({{"level", row.level},
                              {"raw_dps", row.raw_dps},
                              {"filtered_dps", row.filtered_dps},
                              {"lowest_dps", row.lowest_dps},
                              {"highest_dps", row.highest_dps},
                              {"mean_moved_max_dps", row.mean_moved_max_dps}});
  }
  fmt::print("{}\n", json.dump());
  return exit_done;
}

}  // namespace gyrocal::cli
