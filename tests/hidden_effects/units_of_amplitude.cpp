#include "tests/hidden_effects/units_of_amplitude.h"

#include <cctype>
#include <map>
#include <utility>

namespace hidden {
namespace {

void replace_all(std::string& text, const std::string& what, const std::string& by) {
  for (auto at = text.find(what); at != std::string::npos; at = text.find(what, at + by.size())) {
    text.replace(at, what.size(), by);
  }
}

/// Lower case, no spaces, one spelling of degree, second, hour and root.
std::string one_spelling(const std::string& unit) {
  std::string text;
  for (char c : unit) {
    if (c != ' ') text.push_back(static_cast<char>(std::tolower(static_cast<unsigned char>(c))));
  }
  for (const auto& [what, by] : {std::pair{"°", "deg"},
                                 {"√", "sqrt"},
                                 {"mdeg/s", "mdps"},
                                 {"deg/s", "dps"},
                                 {"sqrts", "sqrt(s)"}}) {
    replace_all(text, what, by);
  }
  return text;
}

}  // namespace

std::optional<Coherent> coherent(double value, const std::string& unit) {
  static const std::map<std::string, std::pair<std::string, double>> known = {
      {"dps", {"rate", 1.0}},
      {"mdps", {"rate", 1e-3}},
      {"deg/h", {"rate", 1.0 / 3600.0}},
      {"dps/(degc/min)", {"rate per heating", 1.0}},
      {"mdps/(degc/min)", {"rate per heating", 1e-3}},
      {"dps/h", {"rate per hour", 1.0}},
      {"mdps/h", {"rate per hour", 1e-3}},
      {"dps/degc", {"rate per degree", 1.0}},
      {"mdps/degc", {"rate per degree", 1e-3}},
      {"dps/g", {"rate per g", 1.0}},
      {"mdps/g", {"rate per g", 1e-3}},
      {"dps/sqrt(s)", {"walk", 1.0}},
      {"mdps/sqrt(s)", {"walk", 1e-3}},
      {"degc", {"temperature", 1.0}},
      {"k", {"temperature", 1.0}},
      {"s", {"time", 1.0}},
      {"min", {"time", 60.0}},
      {"1/degc", {"growth per degree", 1.0}},
      {"%/degc", {"growth per degree", 1e-2}},
      {"%/h", {"growth per hour", 1e-2}},
      {"samples", {"length", 1.0}},
      {"", {"share", 1.0}},
      {"1", {"share", 1.0}},
      {"fraction", {"share", 1.0}},
      {"probability", {"share", 1.0}},
      {"share", {"share", 1.0}},
      {"share_of_samples", {"share", 1.0}},
      {"share_of_codes", {"share", 1.0}},
      {"%", {"share", 1e-2}},
      {"ppm", {"share", 1e-6}}};
  const auto found = known.find(one_spelling(unit));
  if (found == known.end()) return std::nullopt;
  return Coherent{found->second.first, value * found->second.second};
}

}  // namespace hidden
