#include "compensation/drift/allan_likelihood.h"

#include <Eigen/Dense>
#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>

namespace gyrocal {
namespace {

using Amounts = std::array<double, noise_kinds>;

double variance_of_one(std::size_t kind, double m, double correlation_time) {
  switch (kind) {
    case white_noise:
      return 1 / m;
    case flicker_noise:
      return 1;
    case random_walk:
      return m;
    default:
      break;
  }
  const double f = std::exp(-1 / correlation_time);
  const double fm = std::exp(-m / correlation_time);
  const double scale = m * -std::expm1(-1 / correlation_time);
  return (m - 3 * f - m * f * f + 4 * f * fm - f * fm * fm) / (scale * scale);
}

/// The kinds' variances at the observed averaging factors, and what is held.
struct Problem {
  const std::vector<ObservedVariance>& observed;
  NoiseMask mask;
  std::vector<Amounts> unit;
  std::vector<double> held;
};

Problem problem_of(const std::vector<ObservedVariance>& observed, NoiseMask mask,
                   double correlation_time, const Amounts& held) {
  Problem problem{observed, mask, {}, {}};
  for (const ObservedVariance& one : observed) {
    Amounts unit;
    double constant = 0;
    for (std::size_t k = 0; k < noise_kinds; ++k) {
      unit[k] = variance_of_one(k, one.averaged, correlation_time);
      constant += held[k] * unit[k];
      if ((mask >> k & 1u) == 0) unit[k] = 0;
    }
    problem.unit.push_back(unit);
    problem.held.push_back(constant);
  }
  return problem;
}

double expected_at(const Problem& problem, std::size_t i, const Amounts& amount) {
  double variance = problem.held[i];
  for (std::size_t k = 0; k < noise_kinds; ++k) variance += amount[k] * problem.unit[i][k];
  return variance;
}

double cost_of(const Problem& problem, const Amounts& amount) {
  double sum = 0;
  for (std::size_t i = 0; i < problem.observed.size(); ++i) {
    const ObservedVariance& one = problem.observed[i];
    const double expected = expected_at(problem, i, amount);
    sum += one.degrees_of_freedom / 2 * (std::log(expected) + one.variance / expected);
  }
  return sum;
}

/// Each kind alone would meet the observations on average; they share.
Amounts first_guess(const Problem& problem) {
  Amounts guess{};
  for (std::size_t k = 0; k < noise_kinds; ++k) {
    double ratio = 0;
    for (std::size_t i = 0; i < problem.observed.size(); ++i) {
      if (problem.unit[i][k] > 0) ratio += problem.observed[i].variance / problem.unit[i][k];
    }
    guess[k] = ratio / static_cast<double>(problem.observed.size() * noise_kinds);
  }
  return guess;
}

/// Fisher scoring step in the logarithms of the amounts.
Eigen::Vector4d scoring_step(const Problem& problem, const Amounts& amount) {
  Eigen::Vector4d gradient = Eigen::Vector4d::Zero();
  Eigen::Matrix4d information = Eigen::Matrix4d::Zero();
  for (std::size_t i = 0; i < problem.observed.size(); ++i) {
    const ObservedVariance& one = problem.observed[i];
    const double expected = expected_at(problem, i, amount);
    Eigen::Vector4d share;
    for (std::size_t k = 0; k < noise_kinds; ++k) {
      share(static_cast<Eigen::Index>(k)) = amount[k] * problem.unit[i][k] / expected;
    }
    gradient += one.degrees_of_freedom / 2 * (one.variance / expected - 1) * share;
    information += one.degrees_of_freedom / 2 * share * share.transpose();
  }
  // A kind outside the mask, or on its way to zero, has no information; the ridge keeps the system
  // solvable.
  information.diagonal().array() += 1e-9 * (information.trace() + 1e-300);
  return information.ldlt().solve(gradient).cwiseMax(-2.0).cwiseMin(2.0);
}

std::size_t parameters_of(NoiseMask mask) {
  return static_cast<std::size_t>(std::popcount(mask)) + (mask >> correlated_noise & 1u);
}

std::vector<NoiseMask> masks_by_parameters() {
  std::vector<NoiseMask> masks((1u << noise_kinds) - 1);
  std::iota(masks.begin(), masks.end(), 1u);
  std::stable_sort(masks.begin(), masks.end(),
                   [](NoiseMask a, NoiseMask b) { return parameters_of(a) < parameters_of(b); });
  return masks;
}

/// cost_of() a model that meets every observation.
double cost_of_meeting(const std::vector<ObservedVariance>& observed) {
  double sum = 0;
  for (const ObservedVariance& one : observed) {
    sum += one.degrees_of_freedom / 2 * (std::log(one.variance) + 1);
  }
  return sum;
}

double score_of(const NoiseModel& model, double penalty) {
  return 2 * model.minus_log_likelihood + penalty * static_cast<double>(model.parameters());
}

/// Over the logarithm of the correlation time: a coarse grid, then golden sections about its best.
NoiseModel fit_correlated(const std::vector<ObservedVariance>& observed, NoiseMask mask,
                          double longest_correlation) {
  constexpr double shortest = 0.3;
  constexpr double grid = 2.0;
  constexpr double golden = 0.6180339887498949;
  const auto fit = [&](double log_time) { return fit_noise(observed, mask, std::exp(log_time)); };
  NoiseModel best = fit(std::log(shortest));
  for (double time = shortest * grid; time <= longest_correlation; time *= grid) {
    const NoiseModel next = fit(std::log(time));
    if (next.minus_log_likelihood < best.minus_log_likelihood) best = next;
  }
  double low = std::log(best.correlation_time / grid);
  double high = std::log(std::min(best.correlation_time * grid, longest_correlation));
  for (int section = 0; section < 16; ++section) {
    const double inner = golden * (high - low);
    const NoiseModel left = fit(high - inner);
    const NoiseModel right = fit(low + inner);
    const bool go_left = left.minus_log_likelihood < right.minus_log_likelihood;
    (go_left ? high : low) = go_left ? low + inner : high - inner;
    const NoiseModel& better = go_left ? left : right;
    if (better.minus_log_likelihood < best.minus_log_likelihood) best = better;
  }
  return best;
}

}  // namespace

double NoiseModel::variance_at(double averaged) const {
  double variance = 0;
  for (std::size_t k = 0; k < noise_kinds; ++k) {
    if (amount[k] > 0) variance += amount[k] * variance_of_one(k, averaged, correlation_time);
  }
  return variance;
}

std::size_t NoiseModel::parameters() const { return parameters_of(mask); }

NoiseModel fit_noise(const std::vector<ObservedVariance>& observed, NoiseMask mask,
                     double correlation_time, const Amounts& held) {
  constexpr int most_steps = 50;
  constexpr double enough = 1e-8;
  const Problem problem = problem_of(observed, mask, correlation_time, held);
  Amounts amount = first_guess(problem);
  double cost = cost_of(problem, amount);
  for (int step = 0; step < most_steps && mask != 0; ++step) {
    const Eigen::Vector4d direction = scoring_step(problem, amount);
    double length = 1;
    Amounts next = amount;
    double next_cost = cost;
    for (int halving = 0; halving < 20; ++halving, length /= 2) {
      for (std::size_t k = 0; k < noise_kinds; ++k) {
        next[k] = amount[k] * std::exp(length * direction(static_cast<Eigen::Index>(k)));
      }
      next_cost = cost_of(problem, next);
      if (next_cost <= cost) break;
    }
    if (!(next_cost <= cost)) break;
    const double gain = cost - next_cost;
    amount = next;
    cost = next_cost;
    if (gain < enough) break;
  }
  return {mask, amount, correlation_time, cost};
}

NoiseModel choose_noise(const std::vector<ObservedVariance>& observed, double longest_correlation,
                        double penalty) {
  // No model does better than one that meets every observation, so one whose parameters alone cost
  // more than the best so far need not be fitted: most dwells end after the models of one kind.
  const double best_imaginable = 2 * cost_of_meeting(observed);
  NoiseModel best;
  double least = std::numeric_limits<double>::infinity();
  for (const NoiseMask mask : masks_by_parameters()) {
    const bool correlated = (mask >> correlated_noise & 1u) != 0;
    if (best_imaginable + penalty * static_cast<double>(parameters_of(mask)) >= least) break;
    const NoiseModel model = correlated ? fit_correlated(observed, mask, longest_correlation)
                                        : fit_noise(observed, mask, 1);
    // At the longest correlation the fit reaches for a random walk.
    if (correlated && model.correlation_time > 0.9 * longest_correlation) continue;
    if (score_of(model, penalty) >= least) continue;
    least = score_of(model, penalty);
    best = model;
  }
  return best;
}

double deviance(const std::vector<ObservedVariance>& observed, const NoiseModel& model) {
  double sum = 0;
  for (const ObservedVariance& one : observed) {
    const double ratio = one.variance / model.variance_at(one.averaged);
    sum += one.degrees_of_freedom * (ratio - 1 - std::log(ratio));
  }
  return sum;
}

ProfileInterval profile_interval(const std::vector<ObservedVariance>& observed,
                                 const NoiseModel& best, NoiseKind kind, double drop) {
  const NoiseMask others = best.mask & ~(1u << kind);
  const auto within = [&](double amount) {
    Amounts held{};
    held[kind] = amount;
    const NoiseModel model = fit_noise(observed, others, best.correlation_time, held);
    return 2 * (model.minus_log_likelihood - best.minus_log_likelihood) < drop;
  };
  const auto crossing = [&](double inside, double outside) {
    for (int halving = 0; halving < 20; ++halving) {
      const double middle = std::sqrt(inside * outside);
      (within(middle) ? inside : outside) = middle;
    }
    return std::sqrt(inside * outside);
  };
  // A kind that is not in the model starts from a share too small to be seen.
  double start = best.amount[kind];
  if (start == 0) {
    start = std::numeric_limits<double>::infinity();
    for (const ObservedVariance& one : observed) {
      const double unit = variance_of_one(kind, one.averaged, best.correlation_time);
      start = std::min(start, 1e-6 * one.variance / unit);
    }
  }
  constexpr int most_steps = 30;
  double above = start;
  for (int i = 0; i < most_steps && within(above); ++i) above *= 4;
  double below = start;
  for (int i = 0; i < most_steps && within(below); ++i) below /= 4;
  return {within(below) ? 0 : crossing(start, below), crossing(start, above)};
}

}  // namespace gyrocal
