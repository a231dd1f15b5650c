#include "compensation/discrepancy/slow_telegraph.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "compensation/discrepancy/relaxing_drift.h"
#include "compensation/values/log_gamma.h"

namespace gyrocal {
namespace {

struct Levels {
  double level = 0, rise_per_s = 0, fall_per_s = 0, white_variance = 0;  // variance of one second
  Eigen::VectorXd coefficients;
};

struct Expectation {
  double log_likelihood = 0;
  Eigen::VectorXd high;
  double rises = 0, falls = 0, low_s = 0, high_s = 0;
};

/// Chance of ending high after dt, from low and from high.
std::pair<double, double> to_high(const Levels& levels, double dt_s) {
  const double rate = levels.rise_per_s + levels.fall_per_s;
  const double forget = -std::expm1(-rate * dt_s);
  const double share = levels.rise_per_s / rate;
  return {forget * share, 1 - forget * (1 - share)};
}

Expectation expect(const SlowGrid& grid, const Eigen::VectorXd& residual, const Levels& levels) {
  const Eigen::Index n = residual.size();
  Expectation result;
  result.high.resize(n);
  Eigen::VectorXd f0(n), f1(n), scale(n);
  double p1 = levels.rise_per_s / (levels.rise_per_s + levels.fall_per_s);
  for (Eigen::Index k = 0; k < n; ++k) {
    const auto at = static_cast<std::size_t>(k);
    const double variance = levels.white_variance / grid.weight_s[at];
    const double norm = 1 / std::sqrt(2 * std::numbers::pi * variance);
    const auto density = [&](double level) {
      const double e = residual(k) - level;
      return norm * (std::exp(-0.5 * e * e / variance) + 1e-12);
    };
    f0(k) = density(-levels.level / 2);
    f1(k) = density(levels.level / 2);
    if (k > 0) {
      const auto [from_low, from_high] = to_high(levels, grid.t_s[at] - grid.t_s[at - 1]);
      p1 = p1 * from_high + (1 - p1) * from_low;
    }
    const double a1 = p1 * f1(k), a0 = (1 - p1) * f0(k);
    scale(k) = a0 + a1;
    p1 = a1 / scale(k);
    result.high(k) = p1;
    result.log_likelihood += std::log(scale(k));
  }
  double b0 = 1, b1 = 1;
  for (Eigen::Index k = n - 1; k > 0; --k) {
    const auto at = static_cast<std::size_t>(k);
    const double dt_s = grid.t_s[at] - grid.t_s[at - 1];
    const auto [from_low, from_high] = to_high(levels, dt_s);
    const double before = result.high(k - 1);  // still the forward probability
    const double g1 = result.high(k) * b1, g0 = (1 - result.high(k)) * b0;
    const double high_now = g1 / (g0 + g1);
    const double rise = (1 - before) * from_low * f1(k) * b1;
    const double stay_low = (1 - before) * (1 - from_low) * f0(k) * b0;
    const double fall = before * (1 - from_high) * f0(k) * b0;
    const double stay_high = before * from_high * f1(k) * b1;
    const double total = rise + stay_low + fall + stay_high;
    // Across a gap there may have been any number of flips: it counts for nothing.
    if (dt_s < 3 * grid.weight_s[at]) {
      result.rises += rise / total;
      result.falls += fall / total;
      result.low_s += dt_s * (rise + stay_low) / total;
      result.high_s += dt_s * (fall + stay_high) / total;
    }
    const double new_b0 = (from_low * f1(k) * b1 + (1 - from_low) * f0(k) * b0) / scale(k);
    b1 = (from_high * f1(k) * b1 + (1 - from_high) * f0(k) * b0) / scale(k);
    b0 = new_b0;
    result.high(k) = high_now;
  }
  const double g1 = result.high(0) * b1, g0 = (1 - result.high(0)) * b0;
  result.high(0) = g1 / (g0 + g1);
  return result;
}

struct TelegraphRows {
  const SlowGrid& grid;
  Eigen::VectorXd y;
  Eigen::MatrixXd design;
};

struct Weighted {
  Weighted(const TelegraphRows& rows, const Eigen::ArrayXd& weight)
      : root(weight.sqrt()), design(root.asDiagonal() * rows.design) {}
  Eigen::VectorXd root;  // sqrt of the rows' weights
  Eigen::HouseholderQR<Eigen::MatrixXd> design;
};

/// By how much the stays on one level outlast the shortest that are surely seen (one or two rows
/// alone pass for outliers): what chance leaves of them is exponential again. Only stays that begin
/// and end inside a piece of the record without gaps.
std::vector<double> stays_s(const SlowGrid& grid, const Eigen::VectorXd& high, bool upper) {
  std::vector<double> stays;
  double began_s = -1;  // below 0: its beginning was not seen
  for (Eigen::Index k = 1; k < high.size(); ++k) {
    const auto at = static_cast<std::size_t>(k);
    const double dt_s = grid.t_s[at] - grid.t_s[at - 1];
    if (dt_s > 3 * grid.weight_s[at]) began_s = -1;
    const bool before = high(k - 1) > 0.5, now = high(k) > 0.5;
    if (before == now) continue;
    const double flip_s = grid.t_s[at] - dt_s / 2;
    const double beyond_s = flip_s - began_s - 2.5 * dt_s;
    if (before == upper && began_s >= 0 && beyond_s > 0) stays.push_back(beyond_s);
    began_s = flip_s;
  }
  return stays;
}

double log_sum(double a, double b) {
  const double most = std::max(a, b);
  return most + std::log1p(std::exp(std::min(a, b) - most));
}

/// Maximum likelihood of a gamma law over the exponential of the mean. Up to a third of the stays
/// may be exponential beside it: a stay cut in two by noise, or two taken for one, hide no clock.
double gamma_gain(std::vector<double> lengths) {
  if (lengths.size() < 3) return 0;
  const auto n = static_cast<double>(lengths.size());
  const double mean = std::accumulate(lengths.begin(), lengths.end(), 0.0) / n;
  const double log_mean = std::log(mean);
  std::sort(lengths.begin(), lengths.end());
  const auto gain = [&](double shape, double around, double others) {
    const double scale = around / shape;
    const double norm = log_gamma(shape) + shape * std::log(scale);
    const double log_gammas = std::log(1 - others), log_others = std::log(others);
    double sum = 0;
    for (const double s : lengths) {
      const double exponential = -s / mean - log_mean;
      const double gamma = (shape - 1) * std::log(s) - s / scale - norm;
      sum += log_sum(log_gammas + gamma, log_others + exponential) - exponential;
    }
    return sum;
  };
  double best = 0;
  for (const double quantile : {0.3, 0.4, 0.5, 0.6, 0.7}) {
    const double around = lengths[static_cast<std::size_t>(quantile * n)];
    for (double shape = 1; shape < 500; shape *= 1.2) {
      for (const double others : {0.01, 0.1, 0.2, 0.33}) {
        best = std::max(best, gain(shape, around, others));
      }
    }
  }
  return best;
}

void maximise(const TelegraphRows& rows, const Weighted& weighted, const Expectation& expected,
              Levels& levels) {
  const Eigen::VectorXd state = expected.high.array() - 0.5;
  const Eigen::VectorXd without = rows.y - levels.level * state;
  levels.coefficients = weighted.design.solve((weighted.root.array() * without.array()).matrix());
  const Eigen::VectorXd residual = rows.y - rows.design * levels.coefficients;
  const Eigen::ArrayXd w = weighted.root.array().square();
  levels.level = (w * state.array() * residual.array()).sum() / (w.sum() * 0.25);
  const Eigen::ArrayXd spread =
      expected.high.array() * (1 - expected.high.array()) * levels.level * levels.level;
  const Eigen::ArrayXd error = (residual - levels.level * state).array().square() + spread;
  levels.white_variance = (w * error).sum() / static_cast<double>(w.size());
  levels.rise_per_s = std::clamp(expected.rises / std::max(expected.low_s, 1.0), 1e-6, 0.2);
  levels.fall_per_s = std::clamp(expected.falls / std::max(expected.high_s, 1.0), 1e-6, 0.2);
}

/// Expectation and maximisation in turn, from the levels given, until nothing is gained any more.
Expectation climb(const TelegraphRows& rows, const Weighted& weighted, Levels& levels) {
  Expectation expected;
  double before = -1e300;
  for (int i = 0; i < 60; ++i) {
    expected = expect(rows.grid, rows.y - rows.design * levels.coefficients, levels);
    if (expected.log_likelihood - before < 1e-3 && i > 5) break;
    before = expected.log_likelihood;
    maximise(rows, weighted, expected, levels);
  }
  return expected;
}

Eigen::VectorXd rest_of_rows(const SlowModel& model) {
  const SlowStream& stream = model.stream();
  return stream.row_y_dps() - stream.at_rows(model.prediction()) -
         stream.spread_to_rows(model.known_bins());
}

}  // namespace

SlowTelegraph fit_slow_telegraph(const SlowModel& model) {
  const SlowStream& stream = model.stream();
  const SlowGrid& grid = stream.row_grid();
  // What is left of the rows, and the design to correct it by: bins tell its columns well enough.
  const TelegraphRows rows{grid, rest_of_rows(model), stream.spread_to_rows(model.design())};
  const Eigen::ArrayXd weight =
      Eigen::Map<const Eigen::ArrayXd>(grid.weight_s.data(), rows.y.size());
  const Weighted weighted(rows, weight);
  const SlowFit white = fit_given_shape(grid, rows.y, rows.design, {});
  const double sd = model.fit().white_sd_dps / std::sqrt(stream.grid().weight_s.front());
  SlowTelegraph best;
  double log_likelihood = -1e300;  // of design + two levels + white noise
  for (const double level : {1.0, 2.0}) {
    for (const double dwell_s : {60.0, 400.0, 2500.0}) {
      Levels levels{level * sd, 1 / dwell_s, 1 / dwell_s,
                    white.white_sd_dps * white.white_sd_dps * (level > 1.5 ? 0.3 : 0.75),
                    white.coefficients};
      const Expectation expected = climb(rows, weighted, levels);
      if (expected.log_likelihood <= log_likelihood) continue;
      log_likelihood = expected.log_likelihood;
      best.level_dps = std::abs(levels.level);
      best.low_dwell_s = 1 / levels.rise_per_s;
      best.high_dwell_s = 1 / levels.fall_per_s;
      best.flips = expected.rises + expected.falls;
      best.high = expected.high;
      best.level_sd_dps = 2 * std::sqrt(levels.white_variance / weight.sum());
    }
  }
  best.regular_nats =
      gamma_gain(stays_s(grid, best.high, true)) + gamma_gain(stays_s(grid, best.high, false));
  best.lead_nats = log_likelihood - relaxing_log_likelihood(grid, rows.y, rows.design);
  best.high = stream.bin_rows(best.high);
  return best;
}

}  // namespace gyrocal
