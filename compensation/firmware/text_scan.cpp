#include "compensation/firmware/text_scan.h"

#include <charconv>

namespace gyrocal {
namespace {

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view blank = " \t\r\n";
  const auto first = text.find_first_not_of(blank);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(blank) - first + 1);
}

}  // namespace

std::string_view text_between(std::string_view text, std::string_view begin, std::string_view end) {
  const auto start = text.find(begin);
  if (start == std::string_view::npos) return {};
  const auto rest = text.substr(start + begin.size());
  const auto stop = rest.find(end);
  return stop == std::string_view::npos ? std::string_view{} : rest.substr(0, stop);
}

std::optional<float> float_of(std::string_view text) {
  text = trimmed(text);
  if (text.ends_with('f')) text.remove_suffix(1);
  float value = 0;
  const auto [stopped, code] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (code != std::errc{} || stopped != text.data() + text.size()) return std::nullopt;
  return value;
}

std::optional<std::vector<float>> float_list(std::string_view text) {
  std::vector<float> values;
  for (const auto field : split(text, ',')) {
    const auto value = float_of(field);
    if (!value) return std::nullopt;
    values.push_back(*value);
  }
  return values;
}

std::vector<std::string_view> lines_of(std::string_view text) { return split(text, '\n'); }

std::optional<float> float_beside(std::string_view text, std::string_view name, char separator,
                                  std::size_t fields, std::size_t at) {
  for (const auto line : lines_of(text)) {
    const auto parts = split(line, separator);
    if (parts.size() == fields && parts[at] == name) return float_of(parts[at + 1]);
  }
  return std::nullopt;
}

std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> fields;
  for (;;) {
    const auto at = text.find(separator);
    fields.push_back(trimmed(text.substr(0, at)));
    if (at == std::string_view::npos) return fields;
    text.remove_prefix(at + 1);
  }
}

}  // namespace gyrocal
