#include <cmath>
#include <nlohmann/json.hpp>

#include "tests/hidden_effects/judging.h"

namespace hidden {
namespace {

using Json = nlohmann::json;

// Reads that never throw: a finder's JSON may be anything.
std::string text_of(const Json& object, const char* key) {
  const auto found = object.find(key);
  return found != object.end() && found->is_string() ? found->get<std::string>() : std::string();
}

double number_of(const Json& object, const char* key) {
  const auto found = object.find(key);
  return found != object.end() && found->is_number() ? found->get<double>() : std::nan("");
}

std::vector<std::string> words_of(const Json& object, const char* key) {
  std::vector<std::string> words;
  const auto found = object.find(key);
  if (found == object.end() || !found->is_array()) return words;
  for (const auto& word : *found) {
    if (word.is_string()) words.push_back(word.get<std::string>());
  }
  return words;
}

bool is_array(const Json& object, const char* key) {
  const auto found = object.find(key);
  return found != object.end() && found->is_array();
}

TrueEffect true_effect(const Json& json) {
  TrueEffect effect{
      text_of(json, "effect"), {}, json.value("signed", false), words_of(json, "confounded_with")};
  effect.amplitudes.push_back({number_of(json, "amplitude"), text_of(json, "unit")});
  if (is_array(json, "also")) {
    for (const auto& other : json["also"]) {
      effect.amplitudes.push_back({number_of(other, "amplitude"), text_of(other, "unit")});
    }
  }
  return effect;
}

std::string find_trouble(const Json& json) {
  if (json.is_discarded() || !json.is_object()) return "the output is not a JSON object";
  if (text_of(json, "format") != "gyrocal-diagnosis/1") return "format is not gyrocal-diagnosis/1";
  const std::string verdict = text_of(json, "verdict");
  if (verdict != "consistent" && verdict != "explained" && verdict != "unexplained" &&
      verdict != "confounded") {
    return "verdict '" + verdict + "' is none of the four";
  }
  if (!is_array(json, "findings")) return "findings is not a list";
  const auto gap = json.find("gap");
  if (gap == json.end() || !gap->is_object() || !std::isfinite(number_of(*gap, "before")) ||
      !std::isfinite(number_of(*gap, "after"))) {
    return "gap.before or gap.after is not a number";
  }
  return "";
}

}  // namespace

std::optional<Truth> parse_truth(const std::string& text, std::string& trouble) {
  const Json json = Json::parse(text, nullptr, false);
  if (json.is_discarded() || text_of(json, "format") != "gyrocal-hidden-truth/1" ||
      !is_array(json, "effects")) {
    trouble = "is not a gyrocal-hidden-truth/1 file";
    return std::nullopt;
  }
  Truth truth{text_of(json, "case"),
              text_of(json, "session"),
              text_of(json, "category"),
              text_of(json, "level"),
              words_of(json, "accepted_verdicts"),
              {}};
  for (const auto& effect : json["effects"]) truth.effects.push_back(true_effect(effect));
  return truth;
}

Answer parse_answer(const std::string& text) {
  const Json json = Json::parse(text, nullptr, false);
  Answer answer;
  answer.trouble = find_trouble(json);
  if (!answer.trouble.empty()) return answer;
  answer.verdict = text_of(json, "verdict");
  answer.gap_before = number_of(json["gap"], "before");
  answer.gap_after = number_of(json["gap"], "after");
  for (const auto& finding : json["findings"]) {
    if (!finding.is_object() || text_of(finding, "effect").empty()) {
      answer.trouble = "a finding has no effect";
      return answer;
    }
    answer.findings.push_back({text_of(finding, "effect"), number_of(finding, "amplitude"),
                               text_of(finding, "unit"), words_of(finding, "confounded_with")});
  }
  return answer;
}

}  // namespace hidden
