#include "daemon/cli/cell_text.h"

#include <fmt/core.h>

namespace gyrocal::cli {
namespace {

struct AsJson {
  nlohmann::ordered_json operator()(std::monostate) const { return nullptr; }
  template <class Value>
  nlohmann::ordered_json operator()(const Value& value) const {
    return value;
  }
};

struct AsCsv {
  std::string operator()(std::monostate) const { return {}; }
  std::string operator()(std::int64_t value) const { return fmt::format("{}", value); }
  std::string operator()(double value) const { return fmt::format("{}", value); }
  std::string operator()(const std::string& text) const {
    if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
    std::string quoted(1, '"');
    for (const char c : text) quoted.append(c == '"' ? 2 : 1, c);
    quoted.push_back('"');
    return quoted;
  }
};

}  // namespace

nlohmann::ordered_json to_json(const std::vector<std::string>& columns,
                               const std::vector<Cell>& row) {
  nlohmann::ordered_json object;
  for (std::size_t i = 0; i < row.size(); ++i) object[columns[i]] = std::visit(AsJson{}, row[i]);
  return object;
}

std::string to_csv(const std::vector<Cell>& row) {
  std::string line;
  for (std::size_t i = 0; i < row.size(); ++i) {
    if (i > 0) line += ',';
    line += std::visit(AsCsv{}, row[i]);
  }
  return line;
}

}  // namespace gyrocal::cli
