#include "compensation/discrepancy/slow_fit.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "compensation/discrepancy/simplex.h"
#include "compensation/values/assert.h"

namespace gyrocal {
namespace {

// Search range of the logarithms of the two ratios. Below it the part is nothing beside the white
// noise of a day, above it the white noise is nothing.
constexpr double flicker_log_min = -14, flicker_log_max = 6;
constexpr double walk_log_min = -25, walk_log_max = 2;

struct Search {
  const SlowGrid& grid;
  const Eigen::VectorXd& y;
  const Eigen::MatrixXd& design;
  NoiseFamily family;

  [[nodiscard]] SlowNoiseShape shape(const Eigen::VectorXd& logs) const {
    SlowNoiseShape result;
    Eigen::Index at = 0;
    if (family.flicker) {
      result.flicker_ratio = std::exp(std::clamp(logs(at++), flicker_log_min, flicker_log_max));
    }
    if (family.walk) {
      result.walk_ratio = std::exp(std::clamp(logs(at), walk_log_min, walk_log_max));
    }
    return result;
  }

  [[nodiscard]] Eigen::VectorXd logs(const SlowNoiseShape& from) const {
    Eigen::VectorXd result((family.flicker ? 1 : 0) + (family.walk ? 1 : 0));
    Eigen::Index at = 0;
    if (family.flicker) {
      result(at++) = std::log(std::max(from.flicker_ratio, std::exp(flicker_log_min + 4)));
    }
    if (family.walk) result(at) = std::log(std::max(from.walk_ratio, std::exp(walk_log_min + 8)));
    return result;
  }

  [[nodiscard]] SlowFit fit(const SlowNoiseShape& with) const {
    return fit_given_shape(grid, y, design, with);
  }
};

SlowFit better_of(SlowFit a, SlowFit b) {
  return b.log_likelihood > a.log_likelihood ? std::move(b) : std::move(a);
}

SlowFit polish(const Search& search, const SlowNoiseShape& start) {
  const Eigen::VectorXd logs = search.logs(start);
  const auto cost = [&](const Eigen::VectorXd& at) {
    return -search.fit(search.shape(at)).log_likelihood;
  };
  const SimplexResult best =
      minimise(cost, logs, Eigen::VectorXd::Constant(logs.size(), 1.0), 1e-3, 80);
  return search.fit(search.shape(best.at));
}

}  // namespace

SlowFit fit_given_shape(const SlowGrid& grid, const Eigen::VectorXd& y,
                        const Eigen::MatrixXd& design, const SlowNoiseShape& shape) {
  return fit_whitened(SlowWhitener(grid, shape), shape, y, design);
}

SlowFit fit_whitened(const SlowWhitener& whitener, const SlowNoiseShape& shape,
                     const Eigen::VectorXd& y, const Eigen::MatrixXd& design) {
  const Eigen::Index n = y.size();
  const Eigen::Index p = design.cols();
  GYROCAL_ASSERT(design.rows() == n && n > p);
  Eigen::MatrixXd columns(n, p + 1);
  columns << design, y;
  const Eigen::MatrixXd white = whitener.whiten(columns);
  // The R factor of [design y] holds everything: coefficients above, the residual in its corner.
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(white);
  const Eigen::MatrixXd r = qr.matrixQR().topRows(p + 1).triangularView<Eigen::Upper>();
  const double rss = r(p, p) * r(p, p);
  const double variance = rss / static_cast<double>(n);
  SlowFit fit;
  fit.shape = shape;
  fit.white_sd_dps = std::sqrt(variance);
  fit.coefficients =
      r.topLeftCorner(p, p).triangularView<Eigen::Upper>().solve(r.topRightCorner(p, 1));
  const Eigen::MatrixXd inverse =
      r.topLeftCorner(p, p).triangularView<Eigen::Upper>().solve(Eigen::MatrixXd::Identity(p, p));
  fit.standard_error = fit.white_sd_dps * inverse.rowwise().norm();
  fit.log_likelihood =
      -0.5 * (static_cast<double>(n) * (std::log(2 * std::numbers::pi * variance) + 1) +
              whitener.log_determinant());
  return fit;
}

SlowFit fit_noise(const SlowGrid& grid, const Eigen::VectorXd& y, const Eigen::MatrixXd& design,
                  const NoiseFamily& family) {
  const Search search{grid, y, design, family};
  SlowFit best = search.fit({});
  if (!family.flicker && !family.walk) return best;
  SlowFit start = best;
  for (double flicker_log : {-9.0, -6.0, -3.0, 0.0}) {
    for (double walk_log : {-19.0, -15.0, -11.0, -7.0}) {
      SlowNoiseShape shape;
      if (family.flicker) shape.flicker_ratio = std::exp(flicker_log);
      if (family.walk) shape.walk_ratio = std::exp(walk_log);
      start = better_of(std::move(start), search.fit(shape));
      if (!family.walk) break;
    }
    if (!family.flicker) break;
  }
  best = better_of(std::move(best), polish(search, start.shape));
  if (family.flicker && family.walk) {
    best = better_of(std::move(best), fit_noise(grid, y, design, {.flicker = true}));
    best = better_of(std::move(best), fit_noise(grid, y, design, {.walk = true}));
  }
  return best;
}

SlowFit refit_noise(const SlowGrid& grid, const Eigen::VectorXd& y, const Eigen::MatrixXd& design,
                    const NoiseFamily& family, const SlowNoiseShape& start) {
  const Search search{grid, y, design, family};
  SlowFit best = search.fit({});
  if (!family.flicker && !family.walk) return best;
  return better_of(std::move(best), polish(search, start));
}

}  // namespace gyrocal
