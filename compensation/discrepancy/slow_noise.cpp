#include "compensation/discrepancy/slow_noise.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "compensation/discrepancy/median.h"
#include "compensation/values/assert.h"

namespace gyrocal {
namespace {

constexpr double tau_ratio = 3.1622776601683795;  // half a decade
constexpr std::size_t states_max = 16;
using States = std::array<double, states_max>;

double median_step_s(const std::vector<double>& t_s) {
  std::vector<double> step(t_s.size() - 1);
  for (std::size_t i = 0; i + 1 < t_s.size(); ++i) step[i] = t_s[i + 1] - t_s[i];
  return median_of(std::move(step));
}

/// The covariance of a few states and its two moves. Plain arrays: this is the innermost loop.
class Covariance {
 public:
  explicit Covariance(std::size_t states) : n_(states) {}
  void set_diagonal(std::size_t i, double value) { at_[i][i] = value; }
  void decay_and_add(const States& decay, const States& fresh) {
    for (std::size_t i = 0; i < n_; ++i) {
      for (std::size_t j = 0; j < n_; ++j) at_[i][j] *= decay[i] * decay[j];
      at_[i][i] += fresh[i];
    }
  }
  /// Row sums: the covariance of each state with what is seen. Returns their sum.
  double seen(States& row) const {
    double total = 0;
    for (std::size_t i = 0; i < n_; ++i) {
      row[i] = 0;
      for (std::size_t j = 0; j < n_; ++j) row[i] += at_[i][j];
      total += row[i];
    }
    return total;
  }
  void learn(const States& seen, double innovation) {
    for (std::size_t i = 0; i < n_; ++i) {
      for (std::size_t j = 0; j < n_; ++j) at_[i][j] -= seen[i] * seen[j] / innovation;
    }
  }

 private:
  std::size_t n_;
  std::array<States, states_max> at_{};
};

}  // namespace

std::vector<double> SlowWhitener::flicker_tau_s(const SlowGrid& grid) {
  const double span_s = grid.t_s.back() - grid.t_s.front();
  std::vector<double> tau_s;
  // Faster than a bin a state is white; slower than the span it is a constant or a walk.
  for (double tau = median_step_s(grid.t_s); tau < 2 * span_s && tau_s.size() + 1 < states_max;
       tau *= tau_ratio) {
    tau_s.push_back(tau);
  }
  return tau_s;
}

SlowWhitener::SlowWhitener(const SlowGrid& grid, const SlowNoiseShape& shape) {
  const std::size_t n = grid.t_s.size();
  GYROCAL_ASSERT(n >= 2 && grid.weight_s.size() == n);
  GYROCAL_ASSERT(shape.flicker_ratio >= 0 && shape.walk_ratio >= 0);
  const std::vector<double> tau_s =
      shape.flicker_ratio > 0 ? flicker_tau_s(grid) : std::vector<double>{};
  const std::size_t flickers = tau_s.size();
  states_ = flickers + (shape.walk_ratio > 0 ? 1 : 0);
  // Equal variances a half-decade apart sum to v / (2 f ln ratio); that is B^2 / (2 pi f).
  const double variance = shape.flicker_ratio * std::log(tau_ratio) / std::numbers::pi;

  Covariance covariance(states_);
  for (std::size_t i = 0; i < flickers; ++i) covariance.set_diagonal(i, variance);
  decay_.resize(n * states_);
  gain_.resize(n * states_);
  inverse_sd_.resize(n);
  States decay, fresh{}, seen;
  decay.fill(1.0);
  double dt_known_s = 0;
  bool settled = false;  // evenly spaced for so long that the gain has stopped moving
  for (std::size_t k = 0; k < n; ++k) {
    const bool even = k > 0 && std::abs(grid.t_s[k] - grid.t_s[k - 1] - dt_known_s) < 1e-6 &&
                      grid.weight_s[k] == grid.weight_s[k - 1];
    double* const gain = gain_.data() + k * states_;
    if (settled && even) {
      std::copy_n(gain - states_, states_, gain);
      std::copy_n(decay.begin(), states_,
                  decay_.begin() + static_cast<std::ptrdiff_t>(k * states_));
      inverse_sd_[k] = inverse_sd_[k - 1];
      log_determinant_ -= 2 * std::log(inverse_sd_[k]);
      continue;
    }
    if (k > 0) {
      const double dt_s = grid.t_s[k] - grid.t_s[k - 1];
      if (!even) {
        for (std::size_t i = 0; i < flickers; ++i) {
          decay[i] = std::exp(-dt_s / tau_s[i]);
          fresh[i] = variance * (1 - decay[i] * decay[i]);
        }
        if (states_ > flickers) fresh[flickers] = shape.walk_ratio * dt_s;
        dt_known_s = dt_s;
      }
      covariance.decay_and_add(decay, fresh);
    }
    std::copy_n(decay.begin(), states_, decay_.begin() + static_cast<std::ptrdiff_t>(k * states_));
    const double innovation = covariance.seen(seen) + 1.0 / grid.weight_s[k];
    double moved = 0, size = 0;
    for (std::size_t i = 0; i < states_; ++i) {
      gain[i] = seen[i] / innovation;
      if (k > 0) moved += std::abs(gain[i] - *(gain + i - states_));
      size += std::abs(gain[i]);
    }
    covariance.learn(seen, innovation);
    inverse_sd_[k] = 1.0 / std::sqrt(innovation);
    log_determinant_ += std::log(innovation);
    settled = even && moved <= 1e-8 * size;
  }
}

Eigen::MatrixXd SlowWhitener::whiten(const Eigen::Ref<const Eigen::MatrixXd>& columns) const {
  GYROCAL_ASSERT(columns.rows() == static_cast<Eigen::Index>(inverse_sd_.size()));
  const Eigen::Index width = columns.cols();
  Eigen::MatrixXd white(columns.rows(), width);
  // A block of columns side by side: the inner loops run along it.
  constexpr Eigen::Index lane = 8;
  for (Eigen::Index first = 0; first < width; first += lane) {
    const Eigen::Index used = std::min(lane, width - first);
    std::array<std::array<double, lane>, states_max> state{};
    for (Eigen::Index k = 0; k < columns.rows(); ++k) {
      const auto at = static_cast<std::size_t>(k);
      const double* const decay = decay_.data() + at * states_;
      const double* const gain = gain_.data() + at * states_;
      std::array<double, lane> innovation{};
      for (Eigen::Index c = 0; c < used; ++c) {
        innovation[static_cast<std::size_t>(c)] = columns(k, first + c);
      }
      for (std::size_t i = 0; i < states_; ++i) {
        for (std::size_t c = 0; c < lane; ++c) {
          state[i][c] *= decay[i];
          innovation[c] -= state[i][c];
        }
      }
      for (std::size_t i = 0; i < states_; ++i) {
        for (std::size_t c = 0; c < lane; ++c) state[i][c] += gain[i] * innovation[c];
      }
      for (Eigen::Index c = 0; c < used; ++c) {
        white(k, first + c) = innovation[static_cast<std::size_t>(c)] * inverse_sd_[at];
      }
    }
  }
  return white;
}

}  // namespace gyrocal
