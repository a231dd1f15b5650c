#include "schema/session/session_json.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>

namespace gyrocal {
namespace {

using Json = nlohmann::ordered_json;

/// Reads keys of one object; the first problem is kept, with the object's and the key's name.
class Keys {
 public:
  Keys(const Json& object, std::string source, std::string name)
      : object_(object), source_(std::move(source)), name_(std::move(name)) {
    if (!object_.is_object())
      problem_ = Error{Errc::bad_input, source_ + ": " + shown("", "an object"), ""};
  }

  std::string text(const char* key, const char* expected, const char* fallback = nullptr) {
    const Json* value = find(key, expected, fallback != nullptr);
    if (value == nullptr) return fallback != nullptr ? fallback : "";
    if (value->is_string()) return value->get<std::string>();
    refuse(key, expected);
    return "";
  }
  double positive(const char* key, const char* expected) {
    const Json* value = find(key, expected, false);
    if (value == nullptr) return 1;
    if (value->is_number() && value->get<double>() > 0) return value->get<double>();
    refuse(key, expected);
    return 1;
  }
  double number_or_missing(const char* key) {
    const Json* value = find(key, "a number", true);
    if (value == nullptr || value->is_null()) return missing;
    if (value->is_number()) return value->get<double>();
    refuse(key, "a number or null");
    return missing;
  }
  double number(const char* key) {
    const Json* value = find(key, "a number", false);
    if (value != nullptr && value->is_number()) return value->get<double>();
    if (value != nullptr) refuse(key, "a number");
    return 0;
  }
  int whole(const char* key, std::optional<int> fallback = std::nullopt) {
    constexpr auto expected = "a whole number from 0 to 2147483647";
    const Json* value = find(key, expected, fallback.has_value());
    if (value == nullptr) return fallback.value_or(0);
    if (value->is_number_integer() && value->get<std::int64_t>() >= 0 &&
        value->get<std::int64_t>() <= 2147483647) {
      return value->get<int>();
    }
    refuse(key, expected);
    return 0;
  }
  void refuse(const char* key, const std::string& expected) {
    if (!problem_) problem_ = Error{Errc::bad_input, source_ + ": " + shown(key, expected), ""};
  }
  const std::optional<Error>& problem() const { return problem_; }

 private:
  const Json* find(const char* key, const char* expected, bool optional) {
    if (problem_) return nullptr;
    const auto found = object_.find(key);
    if (found != object_.end()) return &*found;
    if (!optional) refuse(key, expected);
    return nullptr;
  }
  std::string shown(const std::string& key, const std::string& expected) const {
    const auto path = name_.empty() || key.empty() ? name_ + key : name_ + "." + key;
    if (!key.empty() && !object_.contains(key)) return path + " is missing, expected " + expected;
    return path + " = " + (key.empty() ? object_ : object_.at(key)).dump().substr(0, 60) +
           ", expected " + expected;
  }

  const Json& object_;
  std::string source_;
  std::string name_;
  std::optional<Error> problem_;
};

Result<std::vector<SessionDwell>> read_dwells(const Json& root, const std::string& source) {
  const auto list = root.find("dwells");
  if (list == root.end() || !list->is_array() || list->empty()) {
    return fail(Errc::bad_input, source + ": dwells, expected an array with at least one dwell");
  }
  std::vector<SessionDwell> dwells;
  std::set<int> seen;
  for (const Json& element : *list) {
    Keys keys(element, source, fmt::format("dwells[{}]", dwells.size()));
    const int dwell = keys.whole("dwell");
    dwells.push_back({dwell, keys.number_or_missing("setpoint_c"), keys.number("t_start_s")});
    if (keys.problem()) return tl::unexpected(*keys.problem());
    if (!seen.insert(dwell).second) {
      return fail(Errc::bad_input, fmt::format("{}: dwells[{}].dwell = {} stands twice", source,
                                               dwells.size() - 1, dwell));
    }
  }
  std::stable_sort(dwells.begin(), dwells.end(), [](const SessionDwell& a, const SessionDwell& b) {
    return a.t_start_s < b.t_start_s;
  });
  return dwells;
}

Result<Session> read_root(const Json& root, const std::string& source) {
  Keys keys(root, source, "");
  if (keys.problem()) return tl::unexpected(*keys.problem());
  Session session;
  if (keys.text("format", "\"session-csv/1\"") != "session-csv/1") {
    keys.refuse("format", "\"session-csv/1\"");
  }
  const auto unit = keys.text("unit", "\"deg/s\"");
  if (unit != "deg/s") {
    keys.refuse("unit", unit.starts_with("rad") ? "\"deg/s\": multiply the rates by 57.29578"
                                                : "\"deg/s\"");
  }
  session.device = keys.text("device", "a text", "");
  session.axis = keys.text("axis", "\"x\", \"y\" or \"z\"", "z");
  if (session.axis != "x" && session.axis != "y" && session.axis != "z") {
    keys.refuse("axis", "\"x\", \"y\" or \"z\"");
  }
  session.sample_rate_hz = keys.positive("sample_rate_hz", "a number above 0");
  session.monitor_interval_s = keys.positive("monitor_interval_s", "a number of seconds above 0");
  session.lsb_dps = keys.positive("lsb_dps", "the size of one count in deg/s, above 0");
  session.samples_per_dwell = keys.whole("samples_per_dwell");
  if (keys.problem()) return tl::unexpected(*keys.problem());
  auto dwells = read_dwells(root, source);
  if (!dwells) return tl::unexpected(dwells.error());
  session.dwells = std::move(*dwells);
  return session;
}

}  // namespace

Result<Session> parse_session_json(const std::string& text, const std::string& source) {
  try {
    return read_root(Json::parse(text), source);
  } catch (const nlohmann::json::parse_error& error) {
    const auto before = std::string_view(text).substr(0, std::min(error.byte, text.size()));
    const auto line = 1 + std::count(before.begin(), before.end(), '\n');
    const auto column = before.size() - (before.rfind('\n') + 1);
    return fail(Errc::bad_input,
                fmt::format("{} line {}, column {}: not JSON", source, line, column));
  } catch (const nlohmann::json::exception& error) {  // a number outside double, invalid UTF-8
    return fail(Errc::bad_input, fmt::format("{}: {}", source, error.what()));
  }
}

std::string to_session_json(const Session& session) {
  Json dwells = Json::array();
  for (const SessionDwell& dwell : session.dwells) {
    const Json setpoint = std::isnan(dwell.setpoint_c) ? Json(nullptr) : Json(dwell.setpoint_c);
    dwells.push_back(
        {{"dwell", dwell.dwell}, {"setpoint_c", setpoint}, {"t_start_s", dwell.t_start_s}});
  }
  const Json root{{"format", "session-csv/1"},
                  {"device", session.device},
                  {"axis", session.axis},
                  {"unit", "deg/s"},
                  {"sample_rate_hz", session.sample_rate_hz},
                  {"monitor_interval_s", session.monitor_interval_s},
                  {"lsb_dps", session.lsb_dps},
                  {"samples_per_dwell", session.samples_per_dwell},
                  {"dwells", dwells}};
  return root.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace gyrocal
