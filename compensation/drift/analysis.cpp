#include "compensation/drift/analysis.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "compensation/drift/held_out.h"
#include "compensation/drift/list_of.h"
#include "compensation/drift/sensitivity.h"
#include "compensation/grey/translation.h"

namespace gyrocal {
namespace {

double root_mean_square(const std::vector<double>& measured, const std::vector<double>& predicted) {
  return accuracy(measured, predicted).rmse_n;
}

bool is_grey(Method method) { return method == Method::gm11 || method == Method::improved_gm11; }

Result<DriftSeries> series_of(const DriftTable& table, const std::vector<double>& standard_error) {
  const std::size_t n = table.temperature_c.size();
  if (table.zero_drift_dps.size() != n || (!standard_error.empty() && standard_error.size() != n)) {
    return fail(Errc::bad_input,
                fmt::format("{} setpoints, {} zero drifts, {} standard errors", n,
                            table.zero_drift_dps.size(), standard_error.size()),
                "give as many of each");
  }
  auto axis = index_axis(table.temperature_c);
  if (!axis) return tl::unexpected(std::move(axis.error()));
  DriftSeries series{std::move(*axis), std::vector<std::size_t>(n), Eigen::VectorXd(), {}};
  std::iota(series.position.begin(), series.position.end(), std::size_t{0});
  series.drift_dps =
      Eigen::Map<const Eigen::VectorXd>(table.zero_drift_dps.data(), static_cast<Eigen::Index>(n));
  for (std::size_t i = 0; i < n; ++i) {
    if (!std::isfinite(table.zero_drift_dps[i])) {
      return fail(Errc::not_finite,
                  fmt::format("the zero drift at {} degC is {}", table.temperature_c[i],
                              table.zero_drift_dps[i]),
                  "repeat this dwell or leave it out");
    }
    if (!standard_error.empty() && !(standard_error[i] > 0 && std::isfinite(standard_error[i]))) {
      return fail(Errc::out_of_range,
                  fmt::format("the standard error at {} degC is {} deg/s", table.temperature_c[i],
                              standard_error[i]),
                  "a standard error is positive and finite");
    }
  }
  if (!standard_error.empty()) {
    series.weight =
        Eigen::Map<const Eigen::VectorXd>(standard_error.data(), static_cast<Eigen::Index>(n))
            .cwiseAbs2()
            .cwiseInverse();
  }
  return series;
}

/// Errors of predictions on kept-out setpoints, where enough points are left to fit.
void add_held_out_errors(FittedModel& model, Method method, const DriftSeries& series,
                         const MethodSettings& settings) {
  model.loocv_rmse_dps = missing;
  model.block_rmse_dps = missing;
  if (auto one = held_out_predictions(method, series, settings, 0)) {
    model.loocv_rmse_dps = root_mean_square(model.measured_dps, *one);
    model.held_out_dps = std::move(*one);
  } else {
    model.warnings.push_back("no leave-one-out error: " + one.error().what);
  }
  if (const auto block = held_out_predictions(method, series, settings, 1)) {
    model.block_rmse_dps = root_mean_square(model.measured_dps, *block);
  }
}

void add_band(FittedModel& model, Method method, const DriftSeries& series, const DriftCurve& curve,
              MethodSettings settings) {
  if (const auto* spline = std::get_if<Spline>(&curve.shape)) {
    settings.spline_lambda = spline->lambda;
  }
  const auto jacobian = sensitivity(method, series, settings);
  model.effective_parameters = jacobian ? jacobian->trace() : missing;
  model.band_dps.assign(model.fitted_dps.size(), missing);
  if (!jacobian) return;
  const auto n = static_cast<Eigen::Index>(model.fitted_dps.size());
  const Eigen::VectorXd residual =
      series.drift_dps - Eigen::Map<const Eigen::VectorXd>(model.fitted_dps.data(), n);
  const bool weighted = method >= Method::polynomial_1;
  model.band_dps =
      prediction_band(*jacobian, residual, weighted ? series.weight : Eigen::VectorXd());
}

void warn_of_unsupported_degree(FittedModel& model, const DriftSeries& series, int degree) {
  const auto spare = static_cast<int>(series.position.size()) - 2 - (degree + 1);
  if (spare < degree) {
    model.warnings.push_back(fmt::format(
        "the residual polynomial of degree {} is not supported by {} setpoints: {} are left to "
        "judge it by",
        degree, series.position.size(), std::max(spare, 0)));
  }
  int best_degree = degree;
  double best = model.loocv_rmse_dps;
  for (int lower = 0; lower < degree; ++lower) {
    const auto predicted = held_out_predictions(Method::improved_gm11, series, {lower, {}}, 0);
    if (!predicted) continue;
    const double error = root_mean_square(model.measured_dps, *predicted);
    if (error < best || std::isnan(best)) {
      best = error;
      best_degree = lower;
    }
  }
  if (best_degree != degree) {
    model.warnings.push_back(fmt::format(
        "the data do not support residual degree {}: degree {} predicts left-out setpoints to "
        "{:.4f} deg/s, degree {} to {:.4f}",
        degree, best_degree, best, degree, model.loocv_rmse_dps));
  }
}

void add_grey_checks(FittedModel& model, Method method, const DriftSeries& series,
                     const DriftCurve& curve, const MethodSettings& settings) {
  model.grade = grey_grade(model.measured_dps, model.fitted_dps);
  if (!model.grade) {
    model.warnings.emplace_back("the series is constant: C and P are undefined, no grade");
  }
  if (curve.translation_dps != 0) {
    model.warnings.push_back(
        fmt::format("the series holds values <= 0: {:.6g} deg/s was added before the fit and taken "
                    "off again; the result depends on it",
                    curve.translation_dps));
  }
  if (method == Method::improved_gm11) {
    warn_of_unsupported_degree(model, series, settings.improved_degree);
  }
}

Result<FittedModel> fitted_model(Method method, const DriftSeries& series,
                                 const MethodSettings& settings) {
  const auto curve = fit_method(method, series, settings);
  if (!curve) return tl::unexpected(curve.error());
  FittedModel model;
  model.method = name_of(method);
  model.parameters = parameters_of(*curve);
  model.setpoint_c = series.axis.setpoints_c;
  model.measured_dps = list_of(series.drift_dps);
  for (const double t : model.setpoint_c) model.fitted_dps.push_back(curve->at({t}));
  model.training = accuracy(model.measured_dps, model.fitted_dps);
  add_held_out_errors(model, method, series, settings);
  add_band(model, method, series, *curve, settings);
  if (is_grey(method)) add_grey_checks(model, method, series, *curve, settings);
  return model;
}

void recommend(Analysis& analysis) {
  std::vector<const FittedModel*> ranked;
  for (const auto& model : analysis.models) {
    if (std::isfinite(model.loocv_rmse_dps)) ranked.push_back(&model);
  }
  if (ranked.empty()) {
    analysis.reason = "No model is recommended: too few setpoints to hold one out.";
    return;
  }
  std::stable_sort(ranked.begin(), ranked.end(), [](const auto* a, const auto* b) {
    return a->loocv_rmse_dps < b->loocv_rmse_dps;
  });
  const FittedModel& best = *ranked.front();
  analysis.recommended = static_cast<std::size_t>(&best - analysis.models.data());
  std::vector<std::string> others;
  for (std::size_t i = 1; i < ranked.size(); ++i) {
    others.push_back(fmt::format("{} {:.4f}", ranked[i]->method, ranked[i]->loocv_rmse_dps));
  }
  const auto block_best = std::min_element(ranked.begin(), ranked.end(), [](auto* a, auto* b) {
    return a->block_rmse_dps < b->block_rmse_dps;
  });
  const std::string block =
      *block_best == &best
          ? "It leads with a block of three left out as well."
          : fmt::format("With a block of three left out {} leads ({:.4f} against {:.4f}).",
                        (*block_best)->method, (*block_best)->block_rmse_dps, best.block_rmse_dps);
  analysis.reason = fmt::format(
      "{} predicts setpoints it has not seen best: leave-one-out error {:.4f} deg/s{}{}. {}",
      best.method, best.loocv_rmse_dps, others.empty() ? "" : " against ", fmt::join(others, ", "),
      block);
}

void check_class_ratios(Analysis& analysis, const DriftSeries& series) {
  if (series.drift_dps.minCoeff() <= 0) return;  // translated before it matters
  const auto ratios = class_ratios(series.drift_dps);
  if (ratios.outside.empty()) return;
  analysis.warnings.push_back(fmt::format(
      "{} of {} class ratios lie outside ({:.4f}, {:.4f}), first at {} degC: GM(1,1) does not suit "
      "this series",
      ratios.outside.size(), ratios.ratio.size(), ratios.low, ratios.high,
      series.axis.setpoints_c[ratios.outside.front()]));
}

}  // namespace

Result<Analysis> analyse(const DriftTable& table, const AnalysisOptions& options) {
  const auto series = series_of(table, options.standard_error_dps);
  if (!series) return tl::unexpected(series.error());
  const MethodSettings settings{options.improved_degree, {}};
  Analysis analysis;
  for (const Method method : options.methods) {
    auto model = fitted_model(method, *series, settings);
    if (model) {
      analysis.models.push_back(std::move(*model));
    } else {
      analysis.refused.push_back({name_of(method), std::move(model.error())});
    }
  }
  if (analysis.models.empty()) {
    return analysis.refused.empty()
               ? Result<Analysis>(fail(Errc::bad_input, "no method was asked for"))
               : Result<Analysis>(tl::unexpected(analysis.refused.front().error));
  }
  check_class_ratios(analysis, *series);
  recommend(analysis);
  return analysis;
}

}  // namespace gyrocal
