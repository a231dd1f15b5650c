#include "tests/hidden_effects/identifiability.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/hidden_effects/rivals.h"

namespace hidden {
namespace {

constexpr Eigen::Index bins = 400;
constexpr double true_flicker = 0.05;  // variance of each flicker part against the white of a bin

/// One noise somebody could fit, in units of the white variance of a bin: I + flicker F + walk R.
struct FittedNoise {
  Eigen::MatrixXd lower;  ///< Cholesky factor
  double misfit_nats;     ///< what this noise costs when the truth is the true noise alone
};

Eigen::MatrixXd covariance(double flicker, double walk) {
  Eigen::MatrixXd c(bins, bins);
  for (Eigen::Index i = 0; i < bins; ++i) {
    for (Eigen::Index j = 0; j <= i; ++j) {
      double flickering = 0.0;  // sum of exponentials, half a decade apart: 1/f within the session
      for (double tau = 0.5; tau < 3000.0; tau *= 3.1623) {
        flickering += std::exp(-static_cast<double>(i - j) / tau);
      }
      c(i, j) = c(j, i) =
          (i == j ? 1.0 : 0.0) + flicker * flickering + walk * static_cast<double>(j + 1);
    }
  }
  return c;
}

std::vector<FittedNoise> fitted_noises() {
  const Eigen::MatrixXd truth = covariance(true_flicker, 0.0).llt().matrixL();
  const double truth_log_det = 2.0 * truth.diagonal().array().log().sum();
  std::vector<FittedNoise> noises;
  for (double flicker : {0.002, true_flicker, 0.4, 3.0}) {
    for (double walk : {0.0, 1e-3, 1e-2, 1e-1, 1.0}) {
      const Eigen::MatrixXd lower = covariance(flicker, walk).llt().matrixL();
      const double trace = lower.triangularView<Eigen::Lower>().solve(truth).squaredNorm();
      const double log_det = 2.0 * lower.diagonal().array().log().sum();
      const double cost = 0.5 * (log_det + trace - truth_log_det - static_cast<double>(bins));
      noises.push_back({lower, cost});
    }
  }
  return noises;
}

/// What is left of `columns` beside the nuisances, in one noise's own units.
class Whitened {
 public:
  Whitened(const FittedNoise& noise, const Eigen::MatrixXd& nuisance)
      : noise_(noise), basis_(orthonormal(white(nuisance))) {}
  Eigen::MatrixXd rest(const Eigen::MatrixXd& columns) const {
    const Eigen::MatrixXd whitened = white(columns);
    return whitened - basis_ * (basis_.transpose() * whitened);
  }

 private:
  Eigen::MatrixXd white(const Eigen::MatrixXd& columns) const {
    return noise_.lower.triangularView<Eigen::Lower>().solve(columns);
  }
  static Eigen::MatrixXd orthonormal(const Eigen::MatrixXd& columns) {
    const Eigen::HouseholderQR<Eigen::MatrixXd> qr(columns);
    return qr.householderQ() * Eigen::MatrixXd::Identity(columns.rows(), columns.cols());
  }
  const FittedNoise& noise_;
  Eigen::MatrixXd basis_;
};

std::vector<RivalShape> shapes_of(const RivalClass& rival, const Eigen::MatrixXd& raw,
                                  const Whitened& view, const Eigen::VectorXd& signature) {
  const Eigen::MatrixXd seen = view.rest(raw);
  std::vector<RivalShape> shapes;
  for (Eigen::Index k = 0; k < seen.cols(); ++k) {
    const double energy = seen.col(k).squaredNorm();
    if (energy <= 1e-8 * raw.col(k).squaredNorm()) continue;  // a nuisance in disguise
    shapes.push_back({signature.dot(seen.col(k)), energy, rival.least_share, rival.greatest_share});
  }
  return shapes;
}

Eigen::MatrixXd nuisances(const Trajectory& over, const std::vector<Series>& known) {
  Eigen::MatrixXd columns(bins, 4 + static_cast<Eigen::Index>(known.size()));
  for (int power = 0; power < 4; ++power) {
    Series series(over.seconds());
    for (std::size_t i = 0; i < series.size(); ++i) {
      series[i] = std::pow((over.die_c[i] - 20.0) / 30.0, power);
    }
    columns.col(power) = binned(series, bins);
  }
  for (std::size_t k = 0; k < known.size(); ++k) {
    columns.col(4 + static_cast<Eigen::Index>(k)) = binned(known[k], bins);
  }
  return columns;
}

}  // namespace

double RivalShape::left(double amplitude, double signature_energy) const {
  const double share = std::clamp(amplitude * along / energy, least, greatest);
  return amplitude * amplitude * signature_energy +
         share * (share * energy - 2.0 * amplitude * along);
}

void Cost::add(double fixed_nats, double energy, std::vector<RivalShape> shapes) {
  noises_.push_back({fixed_nats, energy, std::move(shapes)});
}

double Cost::at(double amplitude) const {
  double least = std::numeric_limits<double>::max();
  for (const auto& noise : noises_) {
    double left = amplitude * amplitude * noise.energy;
    for (const auto& shape : noise.shapes)
      left = std::min(left, shape.left(amplitude, noise.energy));
    least = std::min(least, noise.fixed_nats + 0.5 * std::max(left, 0.0));
  }
  return least;
}

double Visibility::smallest_lead() const {
  double least = std::numeric_limits<double>::max();
  for (const auto& [rival, lead] : lead_nats) least = std::min(least, lead);
  return least;
}

std::vector<std::string> Visibility::rivals_within(double nats) const {
  std::vector<std::string> close;
  for (const auto& [rival, lead] : lead_nats) {
    if (lead < nats) close.push_back(rival);
  }
  return close;
}

Sight::Sight(const Trajectory& over, const Baseline& baseline, const Series& signature_dps,
             const std::string& name, double white_per_root_hz, const std::vector<Series>& known)
    : name_(name) {
  static const std::vector<FittedNoise> noises = fitted_noises();
  const double bin_s = static_cast<double>(over.seconds()) / static_cast<double>(bins);
  const double white_dps = white_per_root_hz / std::sqrt(bin_s);  // of a bin
  const Eigen::VectorXd signature = binned(signature_dps, bins) / white_dps;
  const Eigen::MatrixXd nuisance = nuisances(over, known);
  const auto rivals = textbook_rivals(over, baseline, bins);
  for (const auto& noise : noises) {
    const Whitened view(noise, nuisance);
    const Eigen::VectorXd seen = view.rest(signature);
    alone_.add(noise.misfit_nats, seen.squaredNorm(), {});
    for (const auto& rival : rivals) {
      beside_[rival.name].add(noise.misfit_nats, seen.squaredNorm(),
                              shapes_of(rival, rival.columns / white_dps, view, seen));
    }
  }
}

double Sight::smallest_amplitude() const {
  double low = 1e-9;
  double high = 1e9;
  for (int i = 0; i < 100; ++i) {
    const double middle = std::sqrt(low * high);
    (alone_.at(middle) < 16.5 ? low : high) = middle;
  }
  return high;
}

Visibility Sight::at(double amplitude) const {
  Visibility seen{alone_.at(amplitude), 0.0, {}};
  if (const auto own = beside_.find(name_); own != beside_.end()) {
    seen.own_loss_nats = own->second.at(amplitude);
  }
  for (const auto& [rival, cost] : beside_) {
    if (rival != name_) seen.lead_nats[rival] = cost.at(amplitude) - seen.own_loss_nats;
  }
  return seen;
}

double flicker_gain_nats(double share) {
  const Eigen::MatrixXd truth = covariance(share, 0.0);
  const double log_det = truth.llt().matrixL().toDenseMatrix().diagonal().array().log().sum();
  // Against white noise of the best size, whose log-likelihood has a closed form.
  const double n = static_cast<double>(bins);
  return 0.5 * n * std::log(truth.trace() / n) - log_det;
}

}  // namespace hidden
