#include "compensation/grey/improved_gm11.h"

#include <fmt/core.h>

namespace gyrocal {
namespace {

double corrected_at(const ImprovedGm11& model, double k) {
  const double x1 = accumulated_at(model.base, k);
  return x1 + value_at(model.residual, x1);
}

}  // namespace

double drift_at(const ImprovedGm11& model, double k) {
  const double first = model.base.first_index;
  if (k >= first + 1) return corrected_at(model, k) - corrected_at(model, k - 1);
  const double at_second = corrected_at(model, first + 1) - corrected_at(model, first);
  return model.base.first_dps + (at_second - model.base.first_dps) * (k - first);
}

Result<ImprovedGm11> fit_improved_gm11(const Eigen::Ref<const Eigen::VectorXd>& drift_dps,
                                       int degree) {
  return fit_improved_gm11(plain_index(drift_dps.size()), drift_dps, degree);
}

Result<ImprovedGm11> fit_improved_gm11(const Eigen::Ref<const Eigen::VectorXd>& index,
                                       const Eigen::Ref<const Eigen::VectorXd>& drift_dps,
                                       int degree) {
  if (degree < 0 || degree > improved_degree_max) {
    return fail(Errc::out_of_range, fmt::format("improved GM(1,1): degree {}", degree),
                fmt::format("choose a degree of 0 to {}", improved_degree_max));
  }
  auto base = fit_gm11(index, drift_dps);
  if (!base) return tl::unexpected(std::move(base.error()));

  const Eigen::Index n = drift_dps.size();
  Eigen::VectorXd predicted(n);
  for (Eigen::Index i = 0; i < n; ++i) predicted(i) = accumulated_at(*base, index(i));
  auto residual = fit_polynomial(predicted, accumulated(index, drift_dps) - predicted, degree);
  if (!residual) return tl::unexpected(std::move(residual.error()));

  ImprovedGm11 model{std::move(*base), std::move(*residual), Eigen::VectorXd(n)};
  for (Eigen::Index i = 0; i < n; ++i) model.fitted_dps(i) = drift_at(model, index(i));
  return model;
}

}  // namespace gyrocal
