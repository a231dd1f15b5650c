#include "compensation/discrepancy/dwell_codes.h"

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>

#include "compensation/discrepancy/dwell_rails.h"
#include "compensation/discrepancy/dwell_shape.h"
#include "compensation/discrepancy/gaussian.h"
#include "compensation/discrepancy/median.h"
#include "compensation/discrepancy/slow_story.h"

namespace gyrocal {
namespace {

constexpr double outlier_sd = 6.5;
constexpr double hole_costs_nats = 4;   // what the spread's own error can make of the last codes
constexpr double hole_left_over = 0.3;  // of what should come, at most
constexpr double expected_enough = 5;   // counts, to tell a hole from bad luck
constexpr double growth_needed_nats = 10;
constexpr double expected_sd = 3.2;  // further out a dwell's own tails decide which codes come
constexpr double loss_usual = 1e-7;  // share of frames the rig itself may lose

bool whole_counts(std::span<const DwellData> dwells, double lsb) {
  if (lsb <= 0) return false;
  std::size_t whole = 0, seen = 0;
  for (const DwellData& dwell : dwells) {
    for (std::size_t i = 0; i < dwell.y_dps.size(); i += 7) {
      const double count = dwell.y_dps[i] / lsb;
      whole += std::abs(count - std::round(count)) < 0.02;
      ++seen;
    }
  }
  return seen > 0 && static_cast<double>(whole) > 0.98 * static_cast<double>(seen);
}

using Histogram = std::map<std::int64_t, double>;

struct Counts {
  Histogram seen, expected;
};

/// Adds what a Gaussian rounded to codes would give for one dwell.
void expect_codes(Histogram& expected, double centre, double sd, double n, double lsb) {
  const std::int64_t low = code_of(centre - expected_sd * sd, lsb),
                     high = code_of(centre + expected_sd * sd, lsb);
  double before = upper_tail(((static_cast<double>(low) - 0.5) * lsb - centre) / sd);
  for (std::int64_t code = low; code <= high; ++code) {
    const double after = upper_tail(((static_cast<double>(code) + 0.5) * lsb - centre) / sd);
    expected[code] += n * (before - after);
    before = after;
  }
}

void find_holes(const Counts& counts, bool two_levels, CodeFindings& findings) {
  for (const auto& [code, expected] : counts.expected) {
    if (expected < expected_enough) continue;
    ++findings.testable;
    const auto at = [&](std::int64_t c) {
      const auto found = counts.seen.find(c);
      return found == counts.seen.end() ? 0.0 : found->second;
    };
    const double seen = at(code);
    if (seen > hole_left_over * expected) continue;
    // Codes come on either side of a hole; beyond a rail they come on one side only.
    const auto comes = [](const auto& entry) { return entry.second >= expected_enough; };
    const bool inside = std::any_of(counts.seen.begin(), counts.seen.lower_bound(code), comes) &&
                        std::any_of(counts.seen.upper_bound(code), counts.seen.end(), comes);
    if (!inside) continue;
    findings.holes.push_back(code);
    findings.holes_nats += expected - seen + (seen > 0 ? seen * std::log(seen / expected) : 0.0);
  }
  if (findings.holes.empty()) return;
  const double testable = findings.testable;
  findings.holes_nats -= std::log(testable) + hole_costs_nats * (two_levels ? 3 : 1);
  const double holes = static_cast<double>(findings.holes.size());
  findings.holes_share = holes / testable;
  findings.holes_share_sd = std::sqrt(findings.holes_share * (1 - findings.holes_share) / testable);
}

/// Spread of a dwell as a rail leaves it: that of the side away from the rail; none where half of
/// the dwell lies on one.
std::optional<double> sd_beside_rails(const DwellShape& shape, double lsb,
                                      const CodeFindings& findings) {
  const bool upper = findings.upper_nats > gate_nats, lower = findings.lower_nats > gate_nats;
  if (upper && shape.median > findings.upper_dps - lsb / 2) return std::nullopt;
  if (lower && shape.median < findings.lower_dps + lsb / 2) return std::nullopt;
  if (upper == lower) return shape.sd;
  return upper ? shape.below : shape.above;
}

void find_outliers(std::span<const DwellData> dwells, double lsb, CodeFindings& findings) {
  const bool holes = !findings.holes.empty();
  double total = 0, size = 0, up = 0;
  for (const DwellData& dwell : dwells) {
    const DwellShape shape = dwell_shape(dwell, lsb);
    const auto told_sd = sd_beside_rails(shape, lsb, findings);
    if (!told_sd) continue;
    const double sd = std::max({*told_sd, 0.35 * lsb, 1e-12});
    total += static_cast<double>(dwell.y_dps.size());
    for (const double y : dwell.y_dps) {
      const double z = std::abs(y - shape.median) / sd;
      // Coarse codes round a harmless value up to half a count further out, holes push it further.
      if (z < outlier_sd + (holes ? 2.5 : 0.5) * lsb / sd) continue;
      ++findings.outliers;
      findings.outlier_nats += std::min(z * z / 2 - 10, 40.0);
      size += z;
      up += y > shape.median;
    }
  }
  if (findings.outliers == 0) return;
  const auto n = static_cast<double>(findings.outliers);
  findings.outlier_share = n / total;
  findings.outlier_share_sd = std::sqrt(n) / total;
  findings.outlier_size_sigma = size / n;
  findings.outliers_one_sided = n >= 6 && (up == 0 || up == n);
}

/// A value and how often it came again at once.
struct Run {
  double value;
  double repeats;
};

std::vector<Run> runs_of(const DwellData& dwell) {
  std::vector<Run> runs;
  for (std::size_t i = 0; i < dwell.y_dps.size(); ++i) {
    const bool again =
        i > 0 && dwell.y_dps[i] == dwell.y_dps[i - 1] && dwell.seq[i] == dwell.seq[i - 1] + 1;
    if (again) {
      runs.back().repeats += 1;
    } else {
      runs.push_back({dwell.y_dps[i], 0});
    }
  }
  return runs;
}

/// How likely each value of a dwell is to come again: by its share of the dwell, or, where the
/// noise stays on one side for a while, by how often it does within runs too short to be stuck.
std::map<double, double> chance_to_repeat(const DwellData& dwell, const std::vector<Run>& runs) {
  constexpr double short_run = 5;
  struct Seen {
    double samples = 0, in_short_runs = 0, short_repeats = 0;
  };
  std::map<double, Seen> seen;
  for (const Run& run : runs) {
    Seen& of_value = seen[run.value];
    of_value.samples += run.repeats + 1;
    if (run.repeats > short_run) continue;
    of_value.in_short_runs += run.repeats + 1;
    of_value.short_repeats += run.repeats;
  }
  const auto n = static_cast<double>(dwell.y_dps.size());
  std::map<double, double> chance;
  for (const auto& [value, of_value] : seen) {
    const double again = (of_value.short_repeats + 1) / (of_value.in_short_runs + 2);
    const double share = (of_value.samples + 1) / n;
    chance[value] = std::min(of_value.in_short_runs > 50 ? std::max(share, again) : share, 1.0);
  }
  return chance;
}

void find_stuck(std::span<const DwellData> dwells, double lsb, CodeFindings& findings) {
  double total = 0, repeats = 0, by_chance = 0, flagged = 0;
  for (const DwellData& dwell : dwells) total += static_cast<double>(dwell.y_dps.size());
  for (const DwellData& dwell : dwells) {
    const auto runs = runs_of(dwell);
    const auto chance = chance_to_repeat(dwell, runs);
    const double sd = dwell_shape(dwell, lsb).sd;
    for (const Run& run : runs) {
      const double p = chance.at(run.value);
      repeats += run.repeats;
      by_chance += (run.repeats + 1) * p;
      // A dwell that sits inside one code is rounding, not sticking.
      const double nats = -run.repeats * std::log(p) - std::log(total);
      if (run.repeats < 3 || nats <= 2 || sd <= 0.35 * lsb) continue;
      findings.stuck_nats += std::min(nats, 40.0);
      ++findings.stuck_runs;
      flagged += run.repeats;
    }
  }
  if (findings.stuck_runs == 0) return;
  const double chance = by_chance / total;
  findings.stuck_share = std::max(flagged / total, (repeats / total - chance) / (1 - chance));
  findings.stuck_length = flagged / static_cast<double>(findings.stuck_runs);
  findings.stuck_share_sd =
      findings.stuck_share / std::sqrt(static_cast<double>(findings.stuck_runs));
}

/// Weighted sum of squares that a straight line over the given columns leaves, and its
/// coefficients.
struct Line {
  Eigen::VectorXd coefficients, variance;
  double chi2 = 0;
};

Line fit_line(const Eigen::MatrixXd& columns, const Eigen::VectorXd& y,
              const Eigen::VectorXd& root) {
  const Eigen::MatrixXd x = root.asDiagonal() * columns;
  const Eigen::VectorXd z = root.asDiagonal() * y;
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(x);
  Line line;
  line.coefficients = qr.solve(z);
  line.chi2 = (z - x * line.coefficients).squaredNorm();
  const Eigen::MatrixXd inverse =
      (x.transpose() * x).ldlt().solve(Eigen::MatrixXd::Identity(x.cols(), x.cols()));
  line.variance = inverse.diagonal();
  return line;
}

/// ln sigma over temperature and over time: of two drivers, each counts for what the other cannot
/// explain, and time only where it must.
void find_spread(std::span<const DwellData> dwells, double lsb, CodeFindings& findings) {
  std::vector<std::array<double, 4>> points;
  for (const DwellData& dwell : dwells) {
    const double sd = white_sd_dps(dwell, lsb);
    if (sd <= 0 || std::isnan(dwell.die_c) || (lsb > 0 && sd < 0.4 * lsb)) continue;
    // Var(ln sd) of the difference estimator is 3/(4 n).
    const double weight = static_cast<double>(dwell.y_dps.size()) / 0.75;
    points.push_back({dwell.die_c - 20, dwell.t_start_s / 3600, std::log(sd), std::sqrt(weight)});
  }
  if (points.size() < 5) return;
  // From the middle on, so that the level told is that of the middle.
  for (const auto& p : points) findings.middle_h += p[1] / static_cast<double>(points.size());
  for (auto& p : points) p[1] -= findings.middle_h;
  const auto n = static_cast<Eigen::Index>(points.size());
  Eigen::MatrixXd both(n, 3);
  Eigen::VectorXd y(n), root(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto& p = points[static_cast<std::size_t>(i)];
    both.row(i) << 1, p[0], p[1];
    y(i) = p[2], root(i) = p[3];
  }
  Eigen::MatrixXd time(n, 2);
  time << both.col(0), both.col(2);
  const Line by_temperature = fit_line(both.leftCols(2), y, root);
  const Line by_time = fit_line(time, y, root), joint = fit_line(both, y, root);
  const double over = std::max(1.0, joint.chi2 / static_cast<double>(n - 3));
  findings.growth_nats = 0.5 * (by_temperature.chi2 - joint.chi2) / over;
  findings.growth_percent_per_h = 100 * joint.coefficients(2);
  findings.growth_sd = 100 * std::sqrt(over * joint.variance(2));
  const bool grows = findings.growth_nats > growth_needed_nats;
  const Line& line = grows ? joint : by_temperature;
  const double over_line =
      std::max(1.0, line.chi2 / static_cast<double>(n - line.coefficients.size()));
  findings.spread_percent_per_c = 100 * line.coefficients(1);
  findings.spread_sd = 100 * std::sqrt(over_line * line.variance(1));
  findings.spread_nats =
      grows ? 0.5 * (by_time.chi2 - joint.chi2) / over
            : 0.5 * std::pow(findings.spread_percent_per_c / findings.spread_sd, 2);
  findings.spread_at_20_dps = std::exp(line.coefficients(0));
}

void find_losses(std::span<const DwellData> dwells, CodeFindings& findings) {
  double bursts = 0;
  for (const DwellData& dwell : dwells) {
    findings.expected += dwell.seq.back() + 1;
    std::int64_t before = -1;
    for (const std::int64_t seq : dwell.seq) {
      if (seq > before + 1) findings.lost += seq - before - 1, bursts += 1;
      before = seq;
    }
  }
  if (findings.lost == 0) return;
  const double usual = loss_usual * static_cast<double>(findings.expected) + 0.01;
  findings.lost_nats = bursts * std::log(bursts / usual) - bursts + usual;
  findings.lost_burst = static_cast<double>(findings.lost) / bursts;
}

/// Median over the dwells; of one that is cut off, what its rest tells.
double usual_white_sd_dps(std::span<const DwellData> dwells, const RangeEnd& lower,
                          const RangeEnd& upper, double lsb) {
  std::vector<double> levels;
  for (std::size_t d = 0; d < dwells.size(); ++d) {
    const auto& pile = upper.piles[d] ? upper.piles[d] : lower.piles[d];
    const double sd = pile ? pile->white_sd_dps : white_sd_dps(dwells[d], lsb);
    if (sd > 0 || !pile) levels.push_back(sd);
  }
  return levels.empty() ? white_sd_dps(dwells.front(), lsb) : median_of(std::move(levels));
}

}  // namespace

CodeFindings inspect_codes(std::span<const DwellData> dwells, double lsb_dps, bool two_levels) {
  CodeFindings findings;
  if (dwells.empty()) return findings;
  findings.quantised = whole_counts(dwells, lsb_dps);
  const double lsb = findings.quantised ? lsb_dps : 0;
  const RangeEnd low_end = range_end(dwells, lsb, false), high_end = range_end(dwells, lsb, true);
  findings.white_sd_dps = usual_white_sd_dps(dwells, low_end, high_end, lsb);
  if (findings.quantised) {
    Counts counts;
    for (std::size_t d = 0; d < dwells.size(); ++d) {
      if (low_end.piles[d] || high_end.piles[d]) continue;
      const DwellData& dwell = dwells[d];
      for (const double y : dwell.y_dps) counts.seen[code_of(y, lsb)] += 1;
      const double rounding = lsb * lsb / 12;
      double square = 0;
      for (const double r : dwell.residual_dps) square += r * r;
      // Glitches widen the variance but not the quantiles, and would ask for codes far out.
      const double robust = 1.05 * dwell_shape(dwell, lsb).sd;
      const double variance =
          std::min(square / static_cast<double>(dwell.residual_dps.size()), robust * robust);
      const double sd = std::sqrt(std::max(variance - rounding, 0.02 * lsb * lsb));
      expect_codes(counts.expected, dwell.mean_dps, sd, static_cast<double>(dwell.y_dps.size()),
                   lsb);
    }
    find_holes(counts, two_levels, findings);
    const bool holes = !findings.holes.empty();
    const Rail upper = find_rail(dwells, high_end, lsb, holes),
               lower = find_rail(dwells, low_end, lsb, holes);
    findings.upper_nats = upper.nats, findings.upper_dps = upper.at_dps;
    findings.lower_nats = lower.nats, findings.lower_dps = lower.at_dps;
  }
  find_outliers(dwells, lsb, findings);
  find_stuck(dwells, lsb, findings);
  find_spread(dwells, lsb, findings);
  find_losses(dwells, findings);
  return findings;
}

}  // namespace gyrocal
