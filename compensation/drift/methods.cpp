#include "compensation/drift/methods.h"

#include <fmt/ranges.h>

#include <array>

#include "compensation/grey/translation.h"
#include "compensation/values/nearest_name.h"

namespace gyrocal {
namespace {

constexpr std::array<std::pair<Method, const char*>, 9> names{{
    {Method::gm11, "gm11"},
    {Method::improved_gm11, "improved_gm11"},
    {Method::least_squares, "least_squares"},
    {Method::polynomial_1, "polynomial_1"},
    {Method::polynomial_2, "polynomial_2"},
    {Method::polynomial_3, "polynomial_3"},
    {Method::polynomial_4, "polynomial_4"},
    {Method::polynomial_5, "polynomial_5"},
    {Method::smoothing_spline, "smoothing_spline"},
}};

constexpr int least_squares_degree = 3;  // the paper's, found by recomputing its Table 2

template <class Fit>
Result<DriftCurve> grey_curve(const DriftSeries& series, const Fit& fit) {
  const double translation = translation_for(series.drift_dps);
  auto model = fit(series.index(), (series.drift_dps.array() + translation).matrix());
  if (!model) return tl::unexpected(std::move(model.error()));
  return DriftCurve{series.axis, std::move(*model), translation};
}

}  // namespace

const std::vector<Method>& all_methods() {
  static const std::vector<Method> all = [] {
    std::vector<Method> list;
    list.reserve(names.size());
    for (const auto& [method, name] : names) list.push_back(method);
    return list;
  }();
  return all;
}

const char* name_of(Method method) { return names[static_cast<std::size_t>(method)].second; }

Result<Method> method_named(std::string_view wanted) {
  std::vector<std::string_view> known;
  for (const auto& [method, name] : names) {
    if (wanted == name) return method;
    known.emplace_back(name);
  }
  return fail(Errc::unknown_name, fmt::format("no method is named \"{}\"", wanted),
              fmt::format("{}known: {}", is_meant(wanted, known), fmt::join(known, ", ")));
}

Eigen::VectorXd DriftSeries::index() const {
  Eigen::VectorXd index(static_cast<Eigen::Index>(position.size()));
  for (std::size_t i = 0; i < position.size(); ++i) {
    index(static_cast<Eigen::Index>(i)) = static_cast<double>(position[i] + 1);
  }
  return index;
}

Eigen::VectorXd DriftSeries::temperature_c() const {
  Eigen::VectorXd temperature(static_cast<Eigen::Index>(position.size()));
  for (std::size_t i = 0; i < position.size(); ++i) {
    temperature(static_cast<Eigen::Index>(i)) = axis.setpoints_c[position[i]];
  }
  return temperature;
}

std::optional<PolynomialDesign> polynomial_design(Method method, const DriftSeries& series) {
  if (method == Method::least_squares)
    return PolynomialDesign{series.index(), {}, least_squares_degree};
  if (method < Method::polynomial_1 || method > Method::polynomial_5) return std::nullopt;
  const int degree = static_cast<int>(method) - static_cast<int>(Method::polynomial_1) + 1;
  return PolynomialDesign{series.temperature_c(), series.weight, degree};
}

Result<DriftCurve> fit_method(Method method, const DriftSeries& series,
                              const MethodSettings& settings) {
  switch (method) {
    case Method::gm11:
      return grey_curve(
          series, [](const auto& index, const auto& drift) { return fit_gm11(index, drift); });
    case Method::improved_gm11:
      return grey_curve(series, [&](const auto& index, const auto& drift) {
        return fit_improved_gm11(index, drift, settings.improved_degree);
      });
    case Method::least_squares:
    case Method::polynomial_1:
    case Method::polynomial_2:
    case Method::polynomial_3:
    case Method::polynomial_4:
    case Method::polynomial_5: {
      const PolynomialDesign design = *polynomial_design(method, series);
      auto fitted = fit_polynomial(design.x, series.drift_dps, design.degree, design.weight);
      if (!fitted) return tl::unexpected(std::move(fitted.error()));
      if (method == Method::least_squares) {
        return DriftCurve{series.axis, IndexPolynomial{std::move(*fitted)}};
      }
      return DriftCurve{series.axis, TemperaturePolynomial{std::move(*fitted)}};
    }
    case Method::smoothing_spline: {
      auto fitted = fit_smoothing_spline(series.temperature_c(), series.drift_dps, series.weight,
                                         settings.spline_lambda);
      if (!fitted) return tl::unexpected(std::move(fitted.error()));
      return DriftCurve{series.axis, std::move(*fitted)};
    }
  }
  return fail(Errc::unknown_name, "no such method");
}

}  // namespace gyrocal
