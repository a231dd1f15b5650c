#include "compensation/discrepancy/slow_limits.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "compensation/discrepancy/off_design.h"
#include "compensation/discrepancy/slow_story.h"

namespace gyrocal {
namespace {

/// What the likelihood gains over white noise, on average, where `shape` is true. The part of the
/// drift that the cubic over temperature takes is left out: of a walk's variance about its mean a
/// seventh remains, of the flicker's states the faster half.
double expected_gain(const SlowGrid& grid, const SlowNoiseShape& shape) {
  const SlowWhitener whitener(grid, shape);
  const auto n = static_cast<double>(grid.t_s.size());
  const double span_s = grid.t_s.back() - grid.t_s.front();
  const auto states = static_cast<double>(SlowWhitener::flicker_tau_s(grid).size());
  double white = 0;
  for (const double weight : grid.weight_s) white += 1 / weight / n;
  const double drift = shape.walk_ratio * span_s / 42 +
                       shape.flicker_ratio * 0.3665 * states / 2;  // ln(sqrt 10)/pi a state
  return 0.5 * (n * std::log(white + drift) - whitener.log_determinant());
}

/// What it costs, in expectation, to claim this noise where all is white: from the filter's answer
/// to one bin far from any edge.
double cost_of_claiming(const SlowWhitener& whitener, Eigen::Index bins) {
  Eigen::MatrixXd impulse = Eigen::MatrixXd::Zero(bins, 1);
  impulse(bins / 3, 0) = 1;
  const Eigen::MatrixXd answer = whitener.whiten(impulse);
  return answer.squaredNorm();
}

/// Noises that cost less than the gate where all is white, with that cost.
struct Claim {
  SlowNoiseShape shape;
  double cost_nats = 0;
};

std::vector<Claim> claims(const SlowModel& model) {
  const SlowNoiseShape present = model.fit().shape;
  std::vector<Claim> all{{present, 0}};
  if (model.noise().flicker || model.noise().walk) return all;
  const SlowGrid& grid = model.stream().grid();
  const auto n = static_cast<double>(grid.t_s.size());
  const double white = cost_of_claiming(SlowWhitener(grid, {}), model.y().size());
  const double white_log = SlowWhitener(grid, {}).log_determinant();
  const auto climb = [&](double SlowNoiseShape::*part, double lowest) {
    for (double ratio = lowest; ratio < 1; ratio *= 1.8) {
      SlowNoiseShape shape;
      shape.*part = ratio;
      const SlowWhitener whitener(grid, shape);
      const double trace = n * cost_of_claiming(whitener, model.y().size()) / white;
      const double cost = 0.5 * (whitener.log_determinant() - white_log + trace - n);
      if (cost > gate_nats) return;
      all.push_back({shape, std::max(cost, 0.0)});
    }
  };
  climb(&SlowNoiseShape::flicker_ratio, 1e-5);
  climb(&SlowNoiseShape::walk_ratio, 1e-10);
  return all;
}

/// The laws' columns at their usual shapes and the amplitude each was made with.
struct Columns {
  std::vector<std::string> effects;
  std::vector<double> at;
  Eigen::MatrixXd columns;
};

Columns usual_columns(const SlowModel& model) {
  Columns usual;
  std::vector<Eigen::VectorXd> columns;
  for (const rig::Effect& effect : rig::catalogue()) {
    if ((effect.channels & rig::slow_drift) == 0) continue;
    const rig::Law& law = *effect.laws.front();
    std::vector<double> values = rig::usual_values(law);
    const auto trials = trial_values(effect, law, model.track());
    if (!trials.empty()) values = trials[trials.size() / 2];
    if (law.info.linear) values[0] = 1;
    usual.effects.emplace_back(effect.name);
    usual.at.push_back(values[0]);
    columns.push_back(model.column(law, values));
  }
  usual.columns.resize(model.y().size(), static_cast<Eigen::Index>(columns.size()));
  for (std::size_t i = 0; i < columns.size(); ++i) {
    usual.columns.col(static_cast<Eigen::Index>(i)) = columns[i];
  }
  return usual;
}

void add_noise_limits(const SlowModel& model, std::map<std::string, double>& limits) {
  const auto limit = [&](double SlowNoiseShape::*part, double lowest) {
    SlowNoiseShape trial = model.fit().shape;
    trial.*part = lowest;
    const double without = expected_gain(model.stream().grid(), model.fit().shape);
    while (trial.*part < 1e6 && expected_gain(model.stream().grid(), trial) - without < gate_nats) {
      trial.*part *= 1.3;
    }
    return model.fit().white_sd_dps * std::sqrt(trial.*part);
  };
  if (!model.noise().flicker) {
    limits["bias_instability"] = 3600 * limit(&SlowNoiseShape::flicker_ratio, 1e-6);
  }
  if (!model.noise().walk) {
    limits["rate_random_walk"] = 1000 * limit(&SlowNoiseShape::walk_ratio, 1e-11);
  }
}

}  // namespace

std::map<std::string, double> slow_limits(const SlowModel& model) {
  const Columns usual = usual_columns(model);
  std::vector<double> amplitude(usual.effects.size(), 0.0);
  for (const Claim& claim : claims(model)) {
    const OffDesign design(model, claim.shape);
    const Eigen::MatrixXd white = design.whitener().whiten(usual.columns);
    const Eigen::MatrixXd off = design.off_white(white);
    for (std::size_t i = 0; i < amplitude.size(); ++i) {
      const auto column = static_cast<Eigen::Index>(i);
      const double left = off.col(column).norm();
      if (left <= 1e-4 * white.col(column).norm() || left == 0) continue;
      amplitude[i] =
          std::max(amplitude[i], std::sqrt(2 * (gate_nats - claim.cost_nats)) *
                                     model.fit().white_sd_dps / left * std::abs(usual.at[i]));
    }
  }
  std::map<std::string, double> limits;
  for (std::size_t i = 0; i < amplitude.size(); ++i) {
    if (amplitude[i] > 0) limits[usual.effects[i]] = amplitude[i];
  }
  add_noise_limits(model, limits);
  return limits;
}

}  // namespace gyrocal
