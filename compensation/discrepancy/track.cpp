#include "compensation/discrepancy/track.h"

#include <Eigen/LU>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>

#include "compensation/rig/thermal_lags.h"
#include "compensation/values/assert.h"

namespace gyrocal {
namespace {

using Column = std::vector<double>;

constexpr double grid_step_s = 10;
constexpr std::size_t grid_points_max = 40'000;
constexpr double tau_min_s = 5, tau_max_s = 3000;
constexpr double gain_span_c_min = 3;  // over less a sensor's gain is only its rounding

/// Values of one monitor column at the grid's instants: straight lines across what is missing,
/// constant beyond the ends. Empty if fewer than two rows have a value.
Column on_grid(const Session& session, double MonitorRow::*column, double t0_s, double step_s,
               std::size_t n) {
  Column t, value;
  for (const MonitorRow& row : session.monitor) {
    if (std::isnan(row.*column)) continue;
    t.push_back(row.t_s);
    value.push_back(row.*column);
  }
  if (t.size() < 2) return {};
  Column grid(n);
  std::size_t right = 1;
  for (std::size_t i = 0; i < n; ++i) {
    const double at = t0_s + step_s * static_cast<double>(i);
    while (right + 1 < t.size() && t[right] < at) ++right;
    const double share = std::clamp((at - t[right - 1]) / (t[right] - t[right - 1]), 0.0, 1.0);
    grid[i] = value[right - 1] + share * (value[right] - value[right - 1]);
  }
  return grid;
}

/// `input` through a first-order lag that stands at `start` at the first instant.
Column lagged(const Column& input, double step_s, double tau_s, double start) {
  rig::ThermalLag lag(tau_s, start);
  lag.advance(0.0, input.front());
  Column output(input.size());
  output[0] = start;
  for (std::size_t i = 1; i < input.size(); ++i) output[i] = lag.advance(step_s, input[i]);
  return output;
}

/// Centred local quadratic over 245 s: what is left of a quantised sensor that must stand in for
/// the chamber's record (discrepancy_methods.md, trap 2).
Column smoothed(const Column& raw, double step_s) {
  const auto half = static_cast<std::ptrdiff_t>(std::max(2.0, std::round(122 / step_s)));
  const auto n = static_cast<std::ptrdiff_t>(raw.size());
  Column smooth(raw.size());
  for (std::ptrdiff_t i = 0; i < n; ++i) {
    const std::ptrdiff_t reach = std::min({half, i, n - 1 - i});
    double s0 = 0, s2 = 0, s4 = 0, y0 = 0, y2 = 0;
    for (std::ptrdiff_t k = -reach; k <= reach; ++k) {
      const double x2 = static_cast<double>(k * k);
      const double y = raw[static_cast<std::size_t>(i + k)];
      s0 += 1, s2 += x2, s4 += x2 * x2, y0 += y, y2 += x2 * y;
    }
    const double determinant = s0 * s4 - s2 * s2;
    smooth[static_cast<std::size_t>(i)] =
        determinant > 0 ? (y0 * s4 - y2 * s2) / determinant : y0 / s0;
  }
  return smooth;
}

/// Finest distance between neighbouring values that occur: the sensor's step; 0 if it is no grid.
double rounding_step(const Session& session) {
  Column values;
  for (const MonitorRow& row : session.monitor) {
    if (!std::isnan(row.board_c)) values.push_back(row.board_c);
  }
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
  if (values.size() < 3) return 0;
  Column gaps;
  for (std::size_t i = 0; i + 1 < values.size(); ++i) {
    if (values[i + 1] - values[i] > 1e-6) gaps.push_back(values[i + 1] - values[i]);
  }
  if (gaps.empty()) return 0;
  std::sort(gaps.begin(), gaps.end());
  const double step = gaps[gaps.size() / 10];
  return step > 0.02 ? step : 0;
}

struct Seen {
  std::vector<std::size_t> at;  // grid index
  Column board_c;
};

Seen board_readings(const Session& session, std::span<const Segment> segments, double t0_s,
                    double step_s, std::size_t n) {
  Seen seen;
  for (const MonitorRow& row : session.monitor) {
    if (std::isnan(row.board_c) || !may_train_on(segments, row.t_s)) continue;
    const double at = std::round((row.t_s - t0_s) / step_s);
    if (at < 0 || at >= static_cast<double>(n)) continue;
    seen.at.push_back(static_cast<std::size_t>(at));
    seen.board_c.push_back(row.board_c);
  }
  return seen;
}

struct SensorMisfit {
  double mean_square = std::numeric_limits<double>::infinity();
  double offset_c = 0, gain = 0;
  double offset_sd_c = 0, gain_sd = 0;
  double mean_square_plain = 0;  // of sensor minus predicted, nothing fitted
};

SensorMisfit misfit(const Seen& seen, const Column& board_c) {
  const auto n = static_cast<Eigen::Index>(seen.at.size());
  Eigen::MatrixXd design(n, 2);
  Eigen::VectorXd difference(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto k = static_cast<std::size_t>(i);
    design(i, 0) = 1;
    design(i, 1) = board_c[seen.at[k]] - 20;
    difference(i) = seen.board_c[k] - board_c[seen.at[k]];
  }
  SensorMisfit result;
  result.mean_square_plain = difference.squaredNorm() / static_cast<double>(n);
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(design);
  if (design.col(1).maxCoeff() - design.col(1).minCoeff() < gain_span_c_min || qr.rank() < 2) {
    result.offset_c = difference.mean();
    result.mean_square = (difference.array() - result.offset_c).square().mean();
    result.offset_sd_c = std::sqrt(result.mean_square / static_cast<double>(n));
    return result;
  }
  const Eigen::Vector2d fit = qr.solve(difference);
  result.offset_c = fit(0);
  result.gain = fit(1);
  result.mean_square = (difference - design * fit).squaredNorm() / static_cast<double>(n);
  const Eigen::Matrix2d inverse = (design.transpose() * design).inverse();
  result.offset_sd_c = std::sqrt(result.mean_square * inverse(0, 0));
  result.gain_sd = std::sqrt(result.mean_square * inverse(1, 1));
  return result;
}

BoardSensorFit fit_board_sensor(const Session& session, const Seen& seen, const Column& chamber,
                                double step_s, double start_c, double tau_of_rig_s) {
  BoardSensorFit fit;
  fit.tau_s = tau_of_rig_s;
  fit.step_c = rounding_step(session);
  if (seen.at.size() < 20) return fit;
  const auto misfit_at = [&](double log_tau) {
    return misfit(seen, lagged(chamber, step_s, std::exp(log_tau), start_c));
  };
  // Golden section: the misfit has one valley in the logarithm of tau.
  constexpr double golden = 0.6180339887498949;
  double low = std::log(tau_min_s), high = std::log(tau_max_s);
  double a = high - golden * (high - low), b = low + golden * (high - low);
  SensorMisfit at_a = misfit_at(a), at_b = misfit_at(b);
  for (int i = 0; i < 24; ++i) {
    if (at_a.mean_square < at_b.mean_square) {
      high = b, b = a, at_b = at_a, a = high - golden * (high - low), at_a = misfit_at(a);
    } else {
      low = a, a = b, at_a = at_b, b = low + golden * (high - low), at_b = misfit_at(b);
    }
  }
  const SensorMisfit with_rig_tau = misfit_at(std::log(tau_of_rig_s));
  // A few dwells with ramps between them tell the lag; a single one does not.
  const bool better = session.dwells.size() >= 4 && at_a.mean_square < with_rig_tau.mean_square;
  const SensorMisfit& chosen = better ? at_a : with_rig_tau;
  if (better) fit.tau_s = std::exp(a);
  fit.tau_fitted = better;
  fit.observed = true;
  fit.offset_c = chosen.offset_c;
  fit.gain = chosen.gain;
  // Readings of one dwell share one rounding error: count dwells, not rows.
  const double dwells = static_cast<double>(std::max<std::size_t>(session.dwells.size(), 1));
  const double per_row = static_cast<double>(seen.at.size()) / dwells;
  fit.offset_sd_c = chosen.offset_sd_c * std::sqrt(per_row);
  fit.gain_sd = chosen.gain_sd * std::sqrt(per_row);
  fit.nats = 0.5 * dwells * std::log(chosen.mean_square_plain / chosen.mean_square);
  return fit;
}

/// Difference over a minute: a chamber's readings have noise and steps of their own.
double derivative_per_min(const Column& values, std::size_t i, double step_s) {
  const auto reach = static_cast<std::size_t>(std::max(1.0, std::round(30 / step_s)));
  const std::size_t left = i < reach ? 0 : i - reach;
  const std::size_t right = std::min(i + reach, values.size() - 1);
  if (right == left) return 0;
  return (values[right] - values[left]) / (step_s * static_cast<double>(right - left)) * 60;
}

}  // namespace

Track make_track(const Session& session, std::span<const Segment> segments,
                 const rig::Baseline& baseline) {
  GYROCAL_ASSERT(!session.monitor.empty());
  Track track;
  const double t_first = session.monitor.front().t_s;
  const double span_s = session.monitor.back().t_s - t_first;
  track.die_tau_s = baseline.die_tau_s;
  track.t0_s = t_first;
  track.step_s = std::max(grid_step_s, span_s / static_cast<double>(grid_points_max));
  const std::size_t n = static_cast<std::size_t>(span_s / track.step_s) + 2;
  const auto column = [&](double MonitorRow::*which) {
    return on_grid(session, which, track.t0_s, track.step_s, n);
  };
  Column chamber = column(&MonitorRow::chamber_c);
  const Column setpoint = column(&MonitorRow::setpoint_c);
  const Column sensor = column(&MonitorRow::board_c);
  Column board;
  track.board_sensor.tau_s = baseline.board_tau_s;
  if (!chamber.empty()) {
    const Seen seen = board_readings(session, segments, track.t0_s, track.step_s, n);
    double start_c = chamber.front();
    const auto fit = [&] {
      return fit_board_sensor(session, seen, chamber, track.step_s, start_c, baseline.board_tau_s);
    };
    track.board_sensor = fit();
    // A board that came in warmer or colder than the air; what its sensor is off by is no such
    // thing.
    const double came_in_c =
        sensor.empty() ? start_c : sensor.front() - track.board_sensor.offset_c;
    if (std::abs(came_in_c - chamber.front()) > 1.5) {
      start_c = came_in_c;
      track.board_sensor = fit();
    }
    board = lagged(chamber, track.step_s, track.board_sensor.tau_s, start_c);
  } else if (!sensor.empty()) {
    track.lost =
        "no chamber column: the die temperature comes from the smoothed board sensor, so rates and "
        "lags are blurred over four minutes and a sensor offset cannot be seen";
    board = smoothed(sensor, track.step_s);
    chamber = board;
    for (std::size_t i = 0; i < n; ++i) {
      chamber[i] += track.board_sensor.tau_s / 60 * derivative_per_min(board, i, track.step_s);
    }
  } else {
    track.lost = "neither chamber nor board temperature: the setpoints stand in for both";
    chamber = setpoint.empty() ? Column(n, 20.0) : setpoint;
    board = lagged(chamber, track.step_s, baseline.board_tau_s, chamber.front());
  }
  const Column die = lagged(board, track.step_s, baseline.die_tau_s, board.front());
  track.record.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    rig::Drivers& now = track.record[i];
    now.t_s = track.t0_s + track.step_s * static_cast<double>(i);
    now.t_on_s = now.t_s;
    now.setpoint_c = setpoint.empty() ? chamber[i] : setpoint[i];
    now.chamber_c = chamber[i];
    now.chamber_rate_c_per_min = derivative_per_min(chamber, i, track.step_s);
    now.board_c = board[i];
    now.die_c = die[i];
    now.die_rate_c_per_min = (board[i] - die[i]) / baseline.die_tau_s * 60;
  }
  return track;
}

}  // namespace gyrocal
