#include "config/drift_model/model_file.h"

#include <fmt/ranges.h>

#include <algorithm>

#include "compensation/values/nearest_name.h"

namespace gyrocal {
namespace {

using Json = nlohmann::ordered_json;

Json text_or_null(const std::string& text) { return text.empty() ? Json(nullptr) : Json(text); }

std::string text_of(const Json& json, const char* key) {
  return json.is_object() && json.contains(key) && json[key].is_string()
             ? json[key].get<std::string>()
             : std::string{};
}

Result<Json> parsed(const std::string& text, const std::string& source) {
  try {
    return Json::parse(text);
  } catch (const nlohmann::json::parse_error& error) {
    const auto end = text.begin() + static_cast<std::ptrdiff_t>(std::min(error.byte, text.size()));
    return fail(
        Errc::bad_input,
        fmt::format("{} line {}: this is no JSON", source, 1 + std::count(text.begin(), end, '\n')),
        "give what gyrocal fit --json printed");
  }
}

std::vector<std::string> methods_of(const Json& models) {
  std::vector<std::string> methods;
  for (const auto& model : models) methods.push_back(text_of(model, "method"));
  return methods;
}

/// The method to take when none was asked for.
std::string default_method(const Json& file, const std::vector<std::string>& methods) {
  const std::string recommended = text_of(file, "recommended");
  return recommended.empty() && methods.size() == 1 ? methods.front() : recommended;
}

Result<Json> chosen(const Json& file, const std::string& source, std::string method) {
  if (file.is_object() && file.contains("method")) {
    if (method.empty() || method == text_of(file, "method")) return file;
    return fail(Errc::unknown_name, fmt::format("{} holds no model \"{}\"", source, method),
                fmt::format("it holds: {}", text_of(file, "method")));
  }
  if (!file.is_object() || !file.contains("models") || !file["models"].is_array()) {
    return fail(Errc::bad_input,
                fmt::format("{}: expected an object with \"models\" or with \"method\"", source),
                "give what gyrocal fit --json printed");
  }
  const auto methods = methods_of(file["models"]);
  if (method.empty()) method = default_method(file, methods);
  const auto found = std::find(methods.begin(), methods.end(), method);
  if (method.empty() || found == methods.end()) {
    const std::vector<std::string_view> known(methods.begin(), methods.end());
    return fail(
        Errc::unknown_name,
        method.empty() ? fmt::format("{} recommends no model", source)
                       : fmt::format("{} holds no model \"{}\"", source, method),
        fmt::format("{}choose one of: {}", is_meant(method, known), fmt::join(methods, ", ")));
  }
  return file["models"][static_cast<std::size_t>(found - methods.begin())];
}

}  // namespace

Json identity_to_json(const SensorIdentity& identity) {
  return {{"board", text_or_null(identity.board)},
          {"axis", text_or_null(identity.axis)},
          {"temperature_scale", text_or_null(identity.temperature_scale)}};
}

Result<ModelOfSensor> model_from_text(const std::string& text, const std::string& source,
                                      const std::string& method) {
  const auto file = parsed(text, source);
  if (!file) return tl::unexpected(file.error());
  const auto json = chosen(*file, source, method);
  if (!json) return tl::unexpected(json.error());
  auto model = model_from_json(*json);
  if (!model) {
    Error error = model.error();
    error.what = source + ": " + error.what;
    return tl::unexpected(std::move(error));
  }
  const Json sensor = file->contains("sensor") ? (*file)["sensor"] : Json();
  return ModelOfSensor{
      {text_of(sensor, "board"), text_of(sensor, "axis"), text_of(sensor, "temperature_scale")},
      std::move(*model)};
}

}  // namespace gyrocal
