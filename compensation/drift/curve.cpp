#include "compensation/drift/curve.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "compensation/drift/list_of.h"

namespace gyrocal {
namespace {

template <class... Fs>
struct Overloaded : Fs... {
  using Fs::operator()...;
};
template <class... Fs>
Overloaded(Fs...) -> Overloaded<Fs...>;

void add_gm11(std::vector<NamedParameter>& out, const Gm11& model) {
  out.push_back({"a", {model.a_per_step}});
  out.push_back({"b", {model.b_dps}});
  out.push_back({"first_index", {model.first_index}});
  out.push_back({"first_dps", {model.first_dps}});
}

/// Takes named values out of what may be a file; remembers the first complaint.
class Reader {
 public:
  Reader(std::string_view method, const std::vector<NamedParameter>& parameters)
      : method_(method), parameters_(parameters) {}

  std::vector<double> list(std::string_view name) {
    const auto found = std::find_if(parameters_.begin(), parameters_.end(),
                                    [&](const auto& p) { return p.name == name; });
    if (found == parameters_.end()) {
      complain(fmt::format("parameter \"{}\" is missing", name));
      return {};
    }
    const bool finite = std::all_of(found->values.begin(), found->values.end(),
                                    [](double v) { return std::isfinite(v); });
    if (!finite) complain(fmt::format("parameter \"{}\" is not finite", name));
    return found->values;
  }
  double number(std::string_view name) {
    const auto values = list(name);
    if (values.size() == 1) return values.front();
    complain(fmt::format("parameter \"{}\" has {} values, expected 1", name, values.size()));
    return missing_number;
  }
  Eigen::VectorXd vector(std::string_view name, std::size_t size_min) {
    const auto values = list(name);
    if (values.size() < size_min) {
      complain(fmt::format("parameter \"{}\" has {} values, expected at least {}", name,
                           values.size(), size_min));
    }
    return Eigen::Map<const Eigen::VectorXd>(values.data(),
                                             static_cast<Eigen::Index>(values.size()));
  }
  Polynomial polynomial(std::string_view centre, std::string_view scale,
                        std::string_view coefficients) {
    Polynomial p{number(centre), number(scale), vector(coefficients, 1)};
    if (!(p.scale > 0)) complain(fmt::format("parameter \"{}\" must be positive", scale));
    return p;
  }
  Gm11 gm11() { return {number("a"), number("b"), number("first_index"), number("first_dps"), {}}; }
  void complain(std::string what) {
    if (complaint_.empty()) complaint_ = std::move(what);
  }
  [[nodiscard]] Result<DriftCurve> result(DriftCurve curve) const {
    if (complaint_.empty()) return curve;
    return fail(Errc::bad_input, fmt::format("model {}: {}", method_, complaint_),
                "fit the model again");
  }

 private:
  static constexpr double missing_number = 0;
  std::string_view method_;
  const std::vector<NamedParameter>& parameters_;
  std::string complaint_;
};

Spline read_spline(Reader& read) {
  Spline spline;
  spline.lambda = read.number("lambda");
  spline.trace = read.number("trace");
  spline.knots = read.vector("knots_c", 3);
  spline.values = read.vector("values_dps", 3);
  spline.second = read.vector("second_derivatives", 3);
  if (spline.values.size() != spline.knots.size() || spline.second.size() != spline.knots.size()) {
    read.complain("knots_c, values_dps and second_derivatives differ in length");
  }
  for (Eigen::Index i = 1; i < spline.knots.size(); ++i) {
    if (spline.knots(i) <= spline.knots(i - 1)) read.complain("knots_c do not rise");
  }
  return spline;
}

Result<Shape> read_shape(std::string_view method, Reader& read) {
  if (method == "gm11") return read.gm11();
  if (method == "improved_gm11") {
    return ImprovedGm11{
        read.gm11(),
        read.polynomial("residual_centre", "residual_scale", "residual_coefficients"),
        {}};
  }
  if (method == "least_squares") {
    return IndexPolynomial{read.polynomial("centre", "scale", "coefficients")};
  }
  if (method.starts_with("polynomial_")) {
    return TemperaturePolynomial{read.polynomial("centre_c", "scale_k", "coefficients")};
  }
  if (method == "smoothing_spline") return read_spline(read);
  return fail(Errc::unknown_name, fmt::format("no method is named \"{}\"", method),
              "known: gm11, improved_gm11, least_squares, polynomial_1 to _5, smoothing_spline");
}

}  // namespace

double DriftCurve::at(Celsius temperature) const {
  const auto value = Overloaded{
      [&](const Gm11& m) { return drift_at(m, index_at(axis, temperature)); },
      [&](const ImprovedGm11& m) { return drift_at(m, index_at(axis, temperature)); },
      [&](const IndexPolynomial& m) { return value_at(m.polynomial, index_at(axis, temperature)); },
      [&](const TemperaturePolynomial& m) { return value_at(m.polynomial, temperature.value); },
      [&](const Spline& s) { return value_at(s, temperature.value); },
  };
  return std::visit(value, shape) - translation_dps;
}

std::vector<NamedParameter> parameters_of(const DriftCurve& curve) {
  std::vector<NamedParameter> out;
  const auto add = Overloaded{
      [&](const Gm11& m) {
        add_gm11(out, m);
        out.push_back({"translation_dps", {curve.translation_dps}});
      },
      [&](const ImprovedGm11& m) {
        add_gm11(out, m.base);
        out.push_back({"translation_dps", {curve.translation_dps}});
        out.push_back({"residual_centre", {m.residual.centre}});
        out.push_back({"residual_scale", {m.residual.scale}});
        out.push_back({"residual_coefficients", list_of(m.residual.coefficients)});
      },
      [&](const IndexPolynomial& m) {
        out.push_back({"centre", {m.polynomial.centre}});
        out.push_back({"scale", {m.polynomial.scale}});
        out.push_back({"coefficients", list_of(m.polynomial.coefficients)});
      },
      [&](const TemperaturePolynomial& m) {
        out.push_back({"centre_c", {m.polynomial.centre}});
        out.push_back({"scale_k", {m.polynomial.scale}});
        out.push_back({"coefficients", list_of(m.polynomial.coefficients)});
      },
      [&](const Spline& s) {
        out.push_back({"lambda", {s.lambda}});
        out.push_back({"trace", {s.trace}});
        out.push_back({"knots_c", list_of(s.knots)});
        out.push_back({"values_dps", list_of(s.values)});
        out.push_back({"second_derivatives", list_of(s.second)});
      },
  };
  std::visit(add, curve.shape);
  out.push_back({"setpoints_c", curve.axis.setpoints_c});
  return out;
}

Result<DriftCurve> curve_of(std::string_view method,
                            const std::vector<NamedParameter>& parameters) {
  Reader read(method, parameters);
  auto shape = read_shape(method, read);
  if (!shape) return tl::unexpected(std::move(shape.error()));
  const bool grey =
      std::holds_alternative<Gm11>(*shape) || std::holds_alternative<ImprovedGm11>(*shape);
  const double translation = grey ? read.number("translation_dps") : 0.0;
  auto axis = index_axis(read.list("setpoints_c"));
  if (!axis) read.complain("setpoints_c: " + axis.error().what);
  return read.result({axis ? std::move(*axis) : IndexAxis{}, std::move(*shape), translation});
}

Result<double> evaluate(const DriftCurve& curve, Celsius temperature, Extrapolation outside) {
  if (!std::isfinite(temperature.value)) {
    return fail(Errc::not_finite, fmt::format("temperature {} degC", temperature.value));
  }
  if (outside == Extrapolation::refuse && !covers(curve.axis, temperature)) {
    return fail(Errc::out_of_range,
                fmt::format("{} degC lies outside the calibrated {} to {} degC", temperature.value,
                            curve.axis.setpoints_c.front(), curve.axis.setpoints_c.back()),
                "calibrate over a wider range, or allow extrapolation");
  }
  return curve.at(temperature);
}

Result<double> evaluate(const FittedModel& model, Celsius temperature, Extrapolation outside) {
  const auto curve = curve_of(model.method, model.parameters);
  if (!curve) return tl::unexpected(curve.error());
  return evaluate(*curve, temperature, outside);
}

}  // namespace gyrocal
