#include "compensation/discrepancy/dwell_colour.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <vector>

#include "compensation/discrepancy/median.h"
#include "compensation/discrepancy/simplex.h"
#include "compensation/discrepancy/slow_noise.h"

namespace gyrocal {
namespace {

/// Averaged power at independent frequencies: every second of the fine bins.
struct Powers {
  std::vector<double> f_hz, power;
  double dwells = 1;
};

Powers independent_powers(const DwellSpectrum& spectrum) {
  Powers powers;
  powers.dwells = spectrum.dwells;
  for (std::size_t k = 4; k + 1 < spectrum.mean.size(); k += 2) {
    // Lines would pass for colour; what stands far out of its surroundings is none.
    const double over = std::min(spectrum.mean[k], 1 + 6 / std::sqrt(powers.dwells));
    powers.f_hz.push_back(static_cast<double>(k) * spectrum.bin_hz);
    powers.power.push_back(over * spectrum.background[k]);
  }
  return powers;
}

/// Whittle's log likelihood of a shape, its overall level profiled out.
template <class Shape>
double whittle(const Powers& powers, const Shape& shape) {
  double logs = 0, ratio = 0;
  const auto n = static_cast<double>(powers.f_hz.size());
  for (std::size_t k = 0; k < powers.f_hz.size(); ++k) {
    const double s = shape(powers.f_hz[k]);
    logs += std::log(s);
    ratio += powers.power[k] / s;
  }
  return -powers.dwells * (logs + n * std::log(ratio / n) + n);
}

// ---- telegraph ----

constexpr double clip_sd = 6;

struct Chain {
  double level = 0, rise = 0, fall = 0, sd = 0;  // rise, fall: probabilities per sample
  std::vector<double> middle;                    // per dwell: mean of the two levels
};

struct Sums {
  double log_likelihood = 0;
  double rise_count = 0, low_count = 0, fall_count = 0, high_count = 0;
  double square = 0, samples = 0;
  double level_above = 0, level_below = 0;
  std::vector<double> middle;
};

/// Forward and backward over one dwell; adds the expected counts.
void expect(const std::vector<double>& y, double middle, const Chain& chain, Sums& sums,
            std::vector<double>& high, std::vector<double>& scale) {
  const std::size_t n = y.size();
  high.resize(n);
  scale.resize(n);
  const double inverse = 1 / (2 * chain.sd * chain.sd);
  const double norm = 1 / (chain.sd * std::sqrt(2 * std::numbers::pi));
  const auto density = [&](double value, double level) {
    return norm * std::exp(-(value - level) * (value - level) * inverse) + 1e-12 * norm;
  };
  const double l0 = middle - chain.level / 2, l1 = middle + chain.level / 2;
  double p1 = chain.rise / (chain.rise + chain.fall);
  for (std::size_t i = 0; i < n; ++i) {
    const double prior = i == 0 ? p1 : p1 * (1 - chain.fall) + (1 - p1) * chain.rise;
    const double a1 = prior * density(y[i], l1), a0 = (1 - prior) * density(y[i], l0);
    scale[i] = a0 + a1;
    p1 = a1 / scale[i];
    high[i] = p1;
    sums.log_likelihood += std::log(scale[i]);
  }
  double b0 = 1, b1 = 1, centre = 0;
  for (std::size_t i = n; i-- > 0;) {
    const double g1 = high[i] * b1, g0 = (1 - high[i]) * b0;
    const double g = g1 / (g0 + g1);
    const double e1 = y[i] - l1, e0 = y[i] - l0;
    sums.square += g * e1 * e1 + (1 - g) * e0 * e0;
    sums.samples += 1;
    centre += y[i] - (g - 0.5) * chain.level;
    sums.level_above += (g - 0.5) * (y[i] - middle);
    sums.level_below += (g - 0.5) * (g - 0.5) + g * (1 - g);
    if (i == 0) break;
    const double f1 = density(y[i], l1) * b1, f0 = density(y[i], l0) * b0;
    const double before1 = high[i - 1];
    const double rise = (1 - before1) * chain.rise * f1,
                 stay0 = (1 - before1) * (1 - chain.rise) * f0;
    const double fall = before1 * chain.fall * f0, stay1 = before1 * (1 - chain.fall) * f1;
    const double total = rise + stay0 + fall + stay1;
    sums.rise_count += rise / total;
    sums.low_count += (rise + stay0) / total;
    sums.fall_count += fall / total;
    sums.high_count += (fall + stay1) / total;
    b0 = (chain.rise * f1 + (1 - chain.rise) * f0) / scale[i];
    b1 = (chain.fall * f0 + (1 - chain.fall) * f1) / scale[i];
  }
  sums.middle.push_back(centre / static_cast<double>(n));
}

using Traces = std::vector<std::vector<double>>;

double improve(const Traces& traces, Chain& chain, int iterations) {
  double log_likelihood = 0;
  std::vector<double> high, scale;
  for (int i = 0; i < iterations; ++i) {
    Sums sums;
    for (std::size_t d = 0; d < traces.size(); ++d) {
      expect(traces[d], chain.middle[d], chain, sums, high, scale);
    }
    const double gained = sums.log_likelihood - log_likelihood;
    log_likelihood = sums.log_likelihood;
    chain.rise = std::clamp(sums.rise_count / std::max(sums.low_count, 1e-9), 1e-6, 0.9);
    chain.fall = std::clamp(sums.fall_count / std::max(sums.high_count, 1e-9), 1e-6, 0.9);
    chain.sd = std::sqrt(sums.square / sums.samples);
    chain.level = sums.level_above / std::max(sums.level_below, 1e-9);
    chain.middle = sums.middle;
    if (i > 3 && std::abs(gained) < 1e-3) break;
  }
  return log_likelihood;
}

double white_log_likelihood(const Traces& traces) {
  double square = 0, n = 0;
  for (const auto& trace : traces) {
    double mean = 0;
    for (const double y : trace) mean += y / static_cast<double>(trace.size());
    for (const double y : trace) square += (y - mean) * (y - mean), n += 1;
  }
  return -0.5 * n * (std::log(2 * std::numbers::pi * square / n) + 1);
}

/// Ornstein-Uhlenbeck + white by a scalar Kalman filter, levels profiled out.
double relax_log_likelihood(const Traces& traces, double keep, double ratio) {
  double logs = 0, square = 0, n = 0;
  for (const auto& trace : traces) {
    double mean = 0;
    for (const double y : trace) mean += y / static_cast<double>(trace.size());
    double state = 0, variance = ratio;
    for (const double y : trace) {
      state *= keep;
      variance = variance * keep * keep + ratio * (1 - keep * keep);
      const double innovation = variance + 1, error = y - mean - state;
      const double gain = variance / innovation;
      state += gain * error;
      variance *= 1 - gain;
      logs += std::log(innovation);
      square += error * error / innovation;
      n += 1;
    }
  }
  return -0.5 * (n * (std::log(2 * std::numbers::pi * square / n) + 1) + logs);
}

double best_relax(const Traces& traces, double tau_samples) {
  const auto cost = [&](const Eigen::VectorXd& x) {
    const double tau = tau_samples * std::exp(std::clamp(x(0), -4.0, 6.0));
    return -relax_log_likelihood(traces, std::exp(-1 / tau), std::exp(std::clamp(x(1), -9.0, 6.0)));
  };
  double best = -1e300;
  for (const double start : {-3.0, -0.5}) {
    best = std::max(
        best,
        -minimise(cost, Eigen::Vector2d(0, start), Eigen::Vector2d(0.8, 1.0), 0.01, 60).value);
  }
  return best;
}

/// Flicker + white by the filter of the slow stream, each dwell with its own level. Dwells of one
/// length share a filter.
double flicker_log_likelihood(const std::map<std::size_t, Eigen::MatrixXd>& by_length,
                              double ratio) {
  double logs = 0, square = 0, n = 0;
  for (const auto& [length, columns] : by_length) {
    SlowGrid grid;
    grid.weight_s.assign(length, 1.0);
    for (std::size_t i = 0; i < length; ++i) grid.t_s.push_back(static_cast<double>(i));
    const SlowWhitener whitener(grid, {.flicker_ratio = ratio, .walk_ratio = 0});
    const Eigen::MatrixXd white = whitener.whiten(columns);
    const Eigen::VectorXd one = white.rightCols(1) / white.rightCols(1).norm();
    const Eigen::Index dwells = columns.cols() - 1;
    square += white.leftCols(dwells).squaredNorm() -
              (one.transpose() * white.leftCols(dwells)).squaredNorm();
    logs += whitener.log_determinant() * static_cast<double>(dwells);
    n += static_cast<double>(length) * static_cast<double>(dwells);
  }
  return -0.5 * (n * (std::log(2 * std::numbers::pi * square / n) + 1) + logs);
}

double best_flicker(const Traces& traces) {
  std::map<std::size_t, std::vector<const std::vector<double>*>> groups;
  for (const auto& trace : traces) groups[trace.size()].push_back(&trace);
  std::map<std::size_t, Eigen::MatrixXd> by_length;
  for (const auto& [length, group] : groups) {
    const auto rows = static_cast<Eigen::Index>(length);
    Eigen::MatrixXd columns(rows, static_cast<Eigen::Index>(group.size()) + 1);
    for (std::size_t k = 0; k < group.size(); ++k) {
      columns.col(static_cast<Eigen::Index>(k)) =
          Eigen::Map<const Eigen::VectorXd>(group[k]->data(), rows);
    }
    columns.rightCols(1).setOnes();
    by_length[length] = std::move(columns);
  }
  const auto cost = [&](const Eigen::VectorXd& x) {
    return -flicker_log_likelihood(by_length, std::exp(std::clamp(x(0), -14.0, 4.0)));
  };
  return -minimise(cost, Eigen::VectorXd::Constant(1, -5.0), Eigen::VectorXd::Ones(1), 0.02, 40)
              .value;
}

Traces clipped_traces(std::span<const DwellData> dwells) {
  Traces traces;
  for (const DwellData& dwell : dwells) {
    std::vector<double> size;
    for (const double y : dwell.y_dps) size.push_back(std::abs(y - dwell.mean_dps));
    const double limit = std::max(clip_sd * 1.4826 * median_of(std::move(size)), 1e-9);
    std::vector<double> trace;
    for (const double y : dwell.y_dps) {
      trace.push_back(std::clamp(y - dwell.mean_dps, -limit, limit));
    }
    traces.push_back(std::move(trace));
  }
  return traces;
}

}  // namespace

DwellColour dwell_colour(const DwellSpectrum& spectrum) {
  DwellColour colour;
  if (spectrum.mean.size() < 64) return colour;
  const Powers powers = independent_powers(spectrum);
  const double white = whittle(powers, [](double) { return 1.0; });
  const auto flicker_cost = [&](const Eigen::VectorXd& x) {
    const double ratio = std::exp(std::clamp(x(0), -12.0, 4.0));
    return -whittle(powers, [ratio](double f) { return 1 + ratio / f; });
  };
  const auto flicker = minimise(flicker_cost, Eigen::VectorXd::Constant(1, -5.0),
                                Eigen::VectorXd::Ones(1), 0.01, 60);
  colour.flicker_nats = std::max(0.0, -flicker.value - white);
  const double tau_max = 1 / powers.f_hz.front();
  const double tau_min = 0.5 / powers.f_hz.back();
  const auto relax_of = [&](const Eigen::VectorXd& x) {
    return std::pair{std::clamp(std::exp(x(0)), tau_min, tau_max),
                     std::exp(std::clamp(x(1), -12.0, 12.0))};
  };
  const auto relax_cost = [&](const Eigen::VectorXd& x) {
    const auto [tau, level] = relax_of(x);
    return -whittle(powers, [&, tau = tau, level = level](double f) {
      const double w = 2 * std::numbers::pi * f * tau;
      return 1 + level / (1 + w * w);
    });
  };
  double best = 0;
  for (const double tau : {0.05, 0.5, 4.0}) {
    const auto found = minimise(relax_cost, Eigen::Vector2d(std::log(tau), -1.0),
                                Eigen::Vector2d(0.8, 1.0), 0.01, 120);
    if (-found.value - white <= best) continue;
    best = -found.value - white;
    const auto [best_tau, level] = relax_of(found.at);
    colour.relax_tau_s = best_tau;
    // Level at f = 0 of a Lorentzian over white: 2 tau v f_s / v_w.
    const double sample_rate_hz = spectrum.bin_hz * 2 * spectrum.samples;
    colour.relax_share = level / (2 * best_tau * sample_rate_hz);
  }
  colour.relax_nats = best;
  return colour;
}

TelegraphFit fit_telegraph(std::span<const DwellData> dwells, double sample_rate_hz) {
  TelegraphFit fit;
  const Traces traces = clipped_traces(dwells);
  if (traces.empty()) return fit;
  double square = 0, n = 0;
  for (const auto& trace : traces) {
    for (const double y : trace) square += y * y, n += 1;
  }
  const double sd = std::sqrt(square / n);
  if (sd == 0) return fit;
  const Traces few(traces.begin(), traces.begin() + static_cast<std::ptrdiff_t>(
                                                        std::min<std::size_t>(6, traces.size())));
  Chain best;
  double best_value = -1e300;
  for (const double level : {0.6, 1.2, 2.0}) {
    for (const double dwell_s : {0.06, 0.5, 4.0}) {
      const double p = std::clamp(1 / (dwell_s * sample_rate_hz), 1e-4, 0.5);
      const double white = std::sqrt(std::max(0.1, 1 - level * level / 4)) * sd;
      Chain chain{level * sd, p, p, white, std::vector<double>(few.size(), 0.0)};
      const double value = improve(few, chain, 8);
      if (value > best_value) best_value = value, best = chain;
    }
  }
  best.middle.assign(traces.size(), 0.0);
  const double value = improve(traces, best, 60);
  fit.nats = value - white_log_likelihood(traces);
  const double tau_samples = 1 / (best.rise + best.fall);
  fit.lead_nats = value - best_relax(traces, std::max(tau_samples, 0.5));
  fit.flicker_lead_nats = value - best_flicker(traces);
  fit.level_dps = std::abs(best.level);
  fit.low_dwell_s = 1 / (best.rise * sample_rate_hz);
  fit.high_dwell_s = 1 / (best.fall * sample_rate_hz);
  if (best.level < 0) std::swap(fit.low_dwell_s, fit.high_dwell_s);
  fit.white_sd_dps = best.sd;
  // Each visit measures the level anew: their number, and the noise within one.
  fit.level_sd_dps = 2 * best.sd / std::sqrt(n);
  return fit;
}

}  // namespace gyrocal
