#include "compensation/discrepancy/smoother.h"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <span>

#include "compensation/discrepancy/off_design.h"

namespace gyrocal {
namespace {

constexpr double noise_worth_nats = 10;
constexpr double rough_or_smooth[] = {0, 1.5};  // see marginal_gain
constexpr int cosines = 25;  // the first is level: with a factor, the design does not hold it

struct Driver {
  std::string name, unit;
  std::vector<double> value;   // at the track's instants
  std::vector<double> factor;  // multiplies the curve: +-1 by direction
};

/// +1 after the last movement of more than `band` upward, -1 after one downward.
std::vector<double> direction(const Track& track, double band_c) {
  std::vector<double> sign(track.record.size(), 1.0);
  double turning = track.record.front().die_c, now = 1;
  for (std::size_t i = 0; i < sign.size(); ++i) {
    const double t = track.record[i].die_c;
    if (now > 0 ? t > turning : t < turning) turning = t;
    if (now > 0 && t < turning - band_c) now = -1, turning = t;
    if (now < 0 && t > turning + band_c) now = 1, turning = t;
    sign[i] = now;
  }
  return sign;
}

std::vector<double> since_step(const Track& track) {
  std::vector<double> log_time(track.record.size());
  double last_s = track.record.front().t_s, setpoint = track.record.front().setpoint_c;
  for (std::size_t i = 0; i < log_time.size(); ++i) {
    const rig::Drivers& now = track.record[i];
    if (std::abs(now.setpoint_c - setpoint) > 0.3) last_s = now.t_s;
    setpoint = now.setpoint_c;
    log_time[i] = std::log10(60 + now.t_s - last_s);
  }
  return log_time;
}

std::vector<Driver> drivers(const Track& track) {
  const auto each = [&](const std::function<double(const rig::Drivers&)>& value) {
    std::vector<double> column;
    for (const rig::Drivers& now : track.record) column.push_back(value(now));
    return column;
  };
  const std::vector<double> ones(track.record.size(), 1.0);
  const std::vector<double> die = each([](const rig::Drivers& d) { return d.die_c; });
  const std::vector<double> sign = direction(track, 1.0);
  const double end_s = track.record.back().t_s;
  const std::vector<double> elapsed =
      each([end_s](const rig::Drivers& d) { return d.t_s / end_s; });
  return {
      {"die temperature", "degC", die, ones},
      {"die temperature, by direction", "degC", die, sign},
      {"heating rate", "degC/min", each([](const rig::Drivers& d) { return d.die_rate_c_per_min; }),
       ones},
      {"chamber minus board", "degC",
       each([](const rig::Drivers& d) { return std::clamp(d.chamber_c - d.board_c, -8.0, 8.0); }),
       ones},
      {"time since the last step", "log10 s", since_step(track), ones},
      {"die temperature, growing with time", "degC", die, elapsed},
      {"time", "h", each([](const rig::Drivers& d) { return d.t_s / 3600; }), ones},
  };
}

struct Basis {
  Eigen::MatrixXd bins;                      // n x cosines, whitened and projected
  std::vector<std::vector<double>> courses;  // at the track's instants
};

Basis basis_of(const SlowModel& model, const Driver& driver) {
  const auto [low, high] = std::minmax_element(driver.value.begin(), driver.value.end());
  Basis basis;
  basis.bins.resize(model.y().size(), cosines);
  for (int k = 0; k < cosines; ++k) {
    std::vector<double> course(driver.value.size());
    for (std::size_t i = 0; i < course.size(); ++i) {
      const double x = (driver.value[i] - *low) / std::max(*high - *low, 1e-12);
      course[i] = driver.factor[i] * std::cos(k * std::numbers::pi * x) / std::sqrt(std::max(k, 1));
    }
    basis.bins.col(k) = model.stream().bin(course);
    basis.courses.push_back(std::move(course));
  }
  return basis;
}

/// Gain of a Gaussian curve of variance v per coefficient, v chosen best; and the coefficients.
struct Marginal {
  double nats = 0;
  Eigen::VectorXd coefficients;
};

/// @param smooth  power of the wave number by which the curve's cosines are smaller than `rough`.
Marginal marginal_gain(const Eigen::MatrixXd& rough, const Eigen::VectorXd& y, double smooth) {
  const Eigen::VectorXd damping =
      Eigen::VectorXd::LinSpaced(rough.cols(), 0, double(rough.cols() - 1))
          .cwiseMax(1)
          .array()
          .pow(-smooth);
  const Eigen::MatrixXd x = rough * damping.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(x.transpose() * x);
  const Eigen::VectorXd& lambda = eigen.eigenvalues();
  const Eigen::VectorXd along = eigen.eigenvectors().transpose() * (x.transpose() * y);
  const auto n = static_cast<double>(y.size());
  const double rss = y.squaredNorm();
  Marginal best{0, Eigen::VectorXd::Zero(x.cols())};
  for (double log_v = -12; log_v < 18; log_v += 0.5) {
    const double v = std::exp(log_v) / std::max(lambda.maxCoeff(), 1e-300);
    double explained = 0, logs = 0;
    Eigen::VectorXd shrunk(lambda.size());
    for (Eigen::Index i = 0; i < lambda.size(); ++i) {
      const double l = std::max(lambda(i), 0.0);
      shrunk(i) = v * along(i) / (1 + v * l);
      explained += along(i) * shrunk(i);
      logs += std::log1p(v * l);
    }
    const double nats = -0.5 * (n * std::log1p(-std::min(explained / rss, 1 - 1e-12)) + logs);
    if (nats > best.nats) best = {nats, damping.asDiagonal() * (eigen.eigenvectors() * shrunk)};
  }
  return best;
}

/// What the bias's own cubic can take is no part of the curve: beside it, its size is free.
void take_cubic_off(const Track& track, std::vector<double>& curve) {
  const auto n = static_cast<Eigen::Index>(curve.size());
  Eigen::MatrixXd cubic(n, 4);
  for (std::size_t degree = 0; degree < 4; ++degree) {
    rig::CubicBias power;
    power.dps[degree] = 1;
    for (Eigen::Index i = 0; i < n; ++i) {
      cubic(i, static_cast<Eigen::Index>(degree)) =
          power.at(track.record[static_cast<std::size_t>(i)].die_c);
    }
  }
  Eigen::Map<Eigen::VectorXd> course(curve.data(), n);
  course -= cubic * cubic.householderQr().solve(course).eval();
}

void describe(const Track& track, const Driver& driver, const Basis& basis,
              const Marginal& marginal, SmoothGain& gain) {
  gain.curve.assign(driver.value.size(), 0.0);
  for (std::size_t i = 0; i < gain.curve.size(); ++i) {
    for (int k = 0; k < cosines; ++k) {
      gain.curve[i] += marginal.coefficients(k) * basis.courses[static_cast<std::size_t>(k)][i];
    }
  }
  take_cubic_off(track, gain.curve);
  double mean = 0;
  for (const double c : gain.curve) mean += c / static_cast<double>(gain.curve.size());
  double square = 0;
  for (std::size_t i = 0; i < gain.curve.size(); ++i) {
    const double off = gain.curve[i] - mean;
    square += off * off / static_cast<double>(gain.curve.size());
    if (std::abs(off) > std::abs(gain.peak_dps)) {
      gain.peak_dps = off;
      gain.peak_at = driver.value[i];
    }
  }
  gain.rms_dps = std::sqrt(square);
}

}  // namespace

std::vector<SmoothGain> smooth_gains(const SlowModel& model) {
  const std::vector<Driver> all = drivers(model.track());
  std::vector<Basis> bases;
  for (const Driver& driver : all) bases.push_back(basis_of(model, driver));
  std::vector<Marginal> best(all.size());
  const auto settings = noise_settings(model);
  // Beside a curve there may be as much noise as without it, or less where the curve does better.
  const bool less = model.noise_gain_nats() > noise_worth_nats;
  for (const SlowNoiseShape& noise : std::span(settings).first(less ? settings.size() : 1)) {
    const OffDesign design(model, noise);
    const Eigen::VectorXd y = design.off(model.y());
    const double without =
        fit_whitened(design.whitener(), noise, model.y(), model.design()).log_likelihood;
    const double loss = model.fit_free().log_likelihood - without;
    for (std::size_t i = 0; i < all.size(); ++i) {
      const Eigen::MatrixXd x = design.off(bases[i].bins);
      for (const double smooth : rough_or_smooth) {
        Marginal marginal = marginal_gain(x, y, smooth);
        marginal.nats -= loss;
        if (marginal.nats > best[i].nats) best[i] = std::move(marginal);
      }
    }
  }
  std::vector<SmoothGain> gains;
  for (std::size_t i = 0; i < all.size(); ++i) {
    SmoothGain gain;
    gain.driver = all[i].name;
    gain.unit = all[i].unit;
    gain.nats = best[i].nats;
    if (gain.nats > 0) describe(model.track(), all[i], bases[i], best[i], gain);
    gains.push_back(std::move(gain));
  }
  std::stable_sort(gains.begin(), gains.end(),
                   [](const SmoothGain& a, const SmoothGain& b) { return a.nats > b.nats; });
  return gains;
}

}  // namespace gyrocal
