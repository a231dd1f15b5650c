#include "schema/session/csv_rows.h"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "compensation/values/nearest_name.h"
#include "compensation/values/records.h"

namespace gyrocal {
namespace {

std::string_view trimmed(std::string_view field) {
  while (!field.empty() && (field.front() == ' ' || field.front() == '\t')) field.remove_prefix(1);
  while (!field.empty() && (field.back() == ' ' || field.back() == '\t')) field.remove_suffix(1);
  return field;
}

std::string_view take_field(std::string_view& line) {
  const auto comma = line.find(',');
  const auto field = line.substr(0, comma);
  line = comma == std::string_view::npos ? std::string_view() : line.substr(comma + 1);
  return field;
}

}  // namespace

CsvRows::CsvRows(std::string_view text, std::string source, std::span<const CsvColumn> columns)
    : rest_(text), source_(std::move(source)), columns_(columns.begin(), columns.end()) {}

Result<CsvRows> CsvRows::start(std::string_view text, std::string source,
                               std::span<const CsvColumn> columns) {
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  CsvRows rows(text, std::move(source), columns);
  if (auto read = rows.read_header(); !read) return tl::unexpected(read.error());
  return rows;
}

std::string_view CsvRows::take_line() {
  ++line_;
  const auto end = rest_.find('\n');
  auto line = rest_.substr(0, end);
  rest_ = end == std::string_view::npos ? std::string_view() : rest_.substr(end + 1);
  if (line.ends_with('\r')) line.remove_suffix(1);
  return line;
}

Result<void> CsvRows::read_header() {
  std::string_view line = take_line();
  const std::string header(line);
  const auto fields = 1 + std::count(line.begin(), line.end(), ',');
  field_of_.assign(columns_.size(), -1);
  std::vector<std::string_view> names;
  for (std::int64_t field = 0; field < fields; ++field) {
    names.push_back(trimmed(take_field(line)));
    const auto column = std::find_if(columns_.begin(), columns_.end(),
                                     [&](const CsvColumn& c) { return c.name == names.back(); });
    if (std::count(names.begin(), names.end(), names.back()) > 1) {
      return fail(Errc::bad_input, fmt::format("{} line 1, column {}: the name \"{}\" stands twice",
                                               source_, field + 1, names.back()));
    }
    wanted_.push_back(column == columns_.end() ? -1 : static_cast<int>(column - columns_.begin()));
    if (column != columns_.end()) {
      field_of_[static_cast<std::size_t>(column - columns_.begin())] = static_cast<int>(field);
    }
  }
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    if (field_of_[i] >= 0) continue;
    // An optional column under a mistyped name would be lost without a word.
    const auto near = nearest_name(columns_[i].name, names);
    const bool taken = std::any_of(columns_.begin(), columns_.end(),
                                   [&](const CsvColumn& c) { return c.name == near; });
    const bool mistyped = !near.empty() && !taken;
    if (!columns_[i].required && !mistyped) continue;
    return fail(
        Errc::bad_input,
        fmt::format("{} line 1: no column \"{}\" in \"{}\"", source_, columns_[i].name, header),
        mistyped ? fmt::format("is \"{}\" meant?", near) : "");
  }
  return {};
}

Result<bool> CsvRows::next(std::span<double> values) {
  std::string_view line;
  do {
    if (rest_.empty()) return false;
    line = take_line();
  } while (line.empty() && rest_.find_first_not_of("\r\n") == std::string_view::npos);

  std::fill(values.begin(), values.end(), missing);
  std::size_t field = 0;
  for (bool more = true; more; ++field) {
    more = line.find(',') != std::string_view::npos;
    const auto text = take_field(line);
    if (field >= wanted_.size()) continue;  // counted, for the message
    if (wanted_[field] < 0) continue;
    const auto column = static_cast<std::size_t>(wanted_[field]);
    if (text.empty() && !columns_[column].required) continue;
    const auto value = parse(column, text);
    if (!value) return tl::unexpected(value.error());
    values[column] = *value;
  }
  if (field != wanted_.size()) return wrong_width(field);
  return true;
}

Result<double> CsvRows::parse(std::size_t column, std::string_view field) const {
  const auto text = trimmed(field);
  if (text.empty() && !columns_[column].required) return missing;
  if (text.empty()) return refuse(column, "is empty, expected a number");
  double value = 0;
  const char* begin = text.data() + (text.front() == '+' ? 1 : 0);
  const char* end = text.data() + text.size();
  const auto parsed = std::from_chars(begin, end, value);
  const bool whole = parsed.ptr == end && parsed.ec == std::errc();
  if (!whole || !std::isfinite(value)) {
    auto refused = refuse(column, fmt::format("\"{}\", expected a finite number", text));
    if (whole) refused.value().code = Errc::not_finite;
    return refused;
  }
  return value;
}

tl::unexpected<Error> CsvRows::wrong_width(std::size_t fields) const {
  return fail(Errc::bad_input, fmt::format("{} line {}: {} fields, expected {} as in the header",
                                           source_, line_, fields, wanted_.size()));
}

std::string CsvRows::place(std::size_t column) const {
  return fmt::format("{} line {}, column {} ({})", source_, line_, field_of_[column] + 1,
                     columns_[column].name);
}

tl::unexpected<Error> CsvRows::refuse(std::size_t column, const std::string& what) const {
  return fail(Errc::bad_input, place(column) + ": " + what);
}

Result<std::int64_t> CsvRows::whole(std::size_t column, double value) const {
  if (value >= 0 && value < 2147483648.0 && value == std::floor(value)) {
    return static_cast<std::int64_t>(value);
  }
  return refuse(column, fmt::format("{}, expected a whole number from 0 to 2147483647", value));
}

}  // namespace gyrocal
