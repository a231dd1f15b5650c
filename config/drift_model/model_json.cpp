#include "config/drift_model/model_json.h"

#include <fmt/core.h>

#include <cmath>

#include "compensation/drift/curve.h"
#include "compensation/values/records.h"

namespace gyrocal {
namespace {

using Json = nlohmann::ordered_json;

Json number_or_null(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json list_to_json(const std::vector<double>& values) {
  Json list = Json::array();
  for (const double value : values) list.push_back(number_or_null(value));
  return list;
}

std::vector<double> list_from_json(const Json& json, const char* key) {
  std::vector<double> values;
  if (!json.contains(key) || !json[key].is_array()) return values;
  for (const auto& item : json[key])
    values.push_back(item.is_number() ? item.get<double>() : missing);
  return values;
}

double number_from_json(const Json& json, const char* key) {
  return json.contains(key) && json[key].is_number() ? json[key].get<double>() : missing;
}

}  // namespace

Json parameters_to_json(const std::vector<NamedParameter>& parameters) {
  Json json = Json::object();
  for (const auto& [name, values] : parameters) {
    json[name] = values.size() == 1 ? Json(values.front()) : Json(values);
  }
  return json;
}

Result<std::vector<NamedParameter>> parameters_from_json(const Json& json) {
  if (!json.is_object()) return fail(Errc::bad_input, "a model's parameters are no JSON object");
  std::vector<NamedParameter> parameters;
  for (const auto& [name, value] : json.items()) {
    NamedParameter parameter{name, {}};
    const Json list = value.is_array() ? value : Json::array({value});
    for (const auto& item : list) {
      if (!item.is_number()) {
        return fail(
            Errc::bad_input,
            fmt::format("model parameter \"{}\" holds {}, expected numbers", name, item.dump()));
      }
      parameter.values.push_back(item.get<double>());
    }
    parameters.push_back(std::move(parameter));
  }
  return parameters;
}

Json model_to_json(const FittedModel& model) {
  Json json;
  json["method"] = model.method;
  json["parameters"] = parameters_to_json(model.parameters);
  json["fitted"] = list_to_json(model.fitted_dps);
  json["rmse_n"] = number_or_null(model.training.rmse_n);
  json["rmse_n_minus_1"] = number_or_null(model.training.rmse_n_minus_1);
  json["mae"] = number_or_null(model.training.mae);
  json["max"] = number_or_null(model.training.max);
  json["loocv_rmse"] = number_or_null(model.loocv_rmse_dps);
  json["block_rmse"] = number_or_null(model.block_rmse_dps);
  json["effective_parameters"] = number_or_null(model.effective_parameters);
  json["setpoints_c"] = list_to_json(model.setpoint_c);
  json["measured"] = list_to_json(model.measured_dps);
  json["held_out"] = list_to_json(model.held_out_dps);
  json["band_95"] = list_to_json(model.band_dps);
  if (model.grade) {
    json["posterior_error_ratio"] = model.grade->posterior_error_ratio;
    json["small_error_probability"] = model.grade->small_error_probability;
    json["grade"] = model.grade->grade;
  }
  json["warnings"] = model.warnings;
  return json;
}

Result<FittedModel> model_from_json(const Json& json) {
  if (!json.is_object() || !json.contains("method") || !json["method"].is_string() ||
      !json.contains("parameters")) {
    return fail(Errc::bad_input, "a model needs \"method\" and \"parameters\"",
                "give what gyrocal fit --json printed");
  }
  auto parameters = parameters_from_json(json["parameters"]);
  if (!parameters) return tl::unexpected(std::move(parameters.error()));
  FittedModel model;
  model.method = json["method"].get<std::string>();
  model.parameters = std::move(*parameters);
  const auto curve = curve_of(model.method, model.parameters);
  if (!curve) return tl::unexpected(curve.error());
  model.setpoint_c = curve->axis.setpoints_c;
  model.measured_dps = list_from_json(json, "measured");
  model.fitted_dps = list_from_json(json, "fitted");
  model.held_out_dps = list_from_json(json, "held_out");
  model.band_dps = list_from_json(json, "band_95");
  model.training = {number_from_json(json, "rmse_n"), number_from_json(json, "rmse_n_minus_1"),
                    number_from_json(json, "mae"), number_from_json(json, "max")};
  model.loocv_rmse_dps = number_from_json(json, "loocv_rmse");
  model.block_rmse_dps = number_from_json(json, "block_rmse");
  model.effective_parameters = number_from_json(json, "effective_parameters");
  if (json.contains("grade") && json["grade"].is_string()) {
    model.grade = GreyGrade{number_from_json(json, "posterior_error_ratio"),
                            number_from_json(json, "small_error_probability"),
                            json["grade"].get<std::string>()};
  }
  if (json.contains("warnings") && json["warnings"].is_array()) {
    for (const auto& warning : json["warnings"]) {
      if (warning.is_string()) model.warnings.push_back(warning.get<std::string>());
    }
  }
  return model;
}

Json analysis_to_json(const Analysis& analysis) {
  Json json;
  json["models"] = Json::array();
  for (const auto& model : analysis.models) json["models"].push_back(model_to_json(model));
  json["recommended"] =
      analysis.recommended ? Json(analysis.models[*analysis.recommended].method) : Json(nullptr);
  json["reason"] = analysis.reason;
  json["refused"] = Json::array();
  for (const auto& refused : analysis.refused) {
    json["refused"].push_back({{"method", refused.method}, {"why", refused.error.what}});
  }
  json["warnings"] = analysis.warnings;
  return json;
}

}  // namespace gyrocal
