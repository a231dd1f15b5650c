#include "daemon/cli/csv_columns.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>

#include "config/text_file.h"

namespace gyrocal::cli {
namespace {

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view blank = " \t\r";
  const auto first = text.find_first_not_of(blank);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(blank) - first + 1);
}

std::vector<std::string> fields_of(std::string_view line) {
  std::vector<std::string> fields;
  for (;;) {
    const auto comma = line.find(',');
    fields.emplace_back(trimmed(line.substr(0, comma)));
    if (comma == std::string_view::npos) return fields;
    line.remove_prefix(comma + 1);
  }
}

/// Takes the first line off `text`; a lone CR (old Mac) ends one too.
std::string_view next_line(std::string_view& text) {
  const auto end = text.find_first_of("\r\n");
  const auto line = text.substr(0, end);
  if (end == std::string_view::npos) {
    text = {};
  } else {
    text.remove_prefix(text.substr(end).starts_with("\r\n") ? end + 2 : end + 1);
  }
  return line;
}

Result<void> check_header(const CsvText& csv, int line) {
  for (std::size_t i = 0; i < csv.header.size(); ++i) {
    const auto& name = csv.header[i];
    if (name.empty()) {
      return fail(Errc::bad_input,
                  fmt::format("{} line {}, column {}: the header has no name here", csv.source,
                              line, i + 1),
                  "remove the trailing comma, or name the column");
    }
    if (std::find(csv.header.begin(), csv.header.begin() + static_cast<std::ptrdiff_t>(i), name) !=
        csv.header.begin() + static_cast<std::ptrdiff_t>(i)) {
      return fail(Errc::bad_input,
                  fmt::format("{} line {}, column {}: the name \"{}\" stands twice in the header",
                              csv.source, line, i + 1, name),
                  "each column needs its own name");
    }
  }
  return {};
}

std::string drained(std::FILE* file) {
  std::string text;
  char block[65536];
  std::size_t got = 0;
  while ((got = std::fread(block, 1, sizeof block, file)) > 0) text.append(block, got);
  return text;
}

}  // namespace

std::string CsvText::place(std::size_t row, std::size_t column) const {
  return fmt::format("{} line {}, column {} ({})", source, line[row], column + 1, header[column]);
}

Result<std::string> read_text(const std::string& path) {
  if (path == "-") return drained(stdin);
  auto text = read_text_file(path);
  if (!text)
    text.error().code = Errc::bad_input;  // the user named it: the exit code is that of usage
  return text;
}

Result<CsvText> parse_csv(std::string_view text, std::string source) {
  constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
  if (text.starts_with(byte_order_mark)) text.remove_prefix(byte_order_mark.size());
  CsvText csv;
  csv.source = std::move(source);
  for (int number = 1; !text.empty(); ++number) {
    const auto line = next_line(text);
    if (trimmed(line).empty()) continue;
    auto fields = fields_of(line);
    if (csv.header.empty()) {
      csv.header = std::move(fields);
      if (auto checked = check_header(csv, number); !checked) {
        return tl::unexpected(std::move(checked.error()));
      }
      continue;
    }
    if (fields.size() != csv.header.size()) {
      const bool longer = fields.size() > csv.header.size();
      return fail(
          Errc::bad_input,
          fmt::format("{} line {}, column {}: {} fields, expected {} ({})", csv.source, number,
                      std::min(fields.size(), csv.header.size()) + 1, fields.size(),
                      csv.header.size(), fmt::join(csv.header, ",")),
          longer ? "remove the trailing comma or the extra field" : "give every column a value");
    }
    csv.rows.push_back(std::move(fields));
    csv.line.push_back(number);
  }
  if (csv.header.empty()) {
    return fail(Errc::bad_input, fmt::format("{} line 1: the file is empty", csv.source),
                "expected a header row of column names, then rows of numbers");
  }
  if (csv.rows.empty()) {
    return fail(Errc::bad_input,
                fmt::format("{} line 2: there is no row below the header", csv.source),
                "expected rows of numbers");
  }
  return csv;
}

Result<std::size_t> column_named(const CsvText& csv, std::string_view name) {
  const auto found = std::find(csv.header.begin(), csv.header.end(), name);
  if (found != csv.header.end()) return static_cast<std::size_t>(found - csv.header.begin());
  return fail(Errc::bad_input,
              fmt::format("{} line 1: no column \"{}\"; the header holds: {}", csv.source, name,
                          fmt::join(csv.header, ", ")),
              fmt::format("name the column {}", name));
}

Result<std::vector<double>> numbers_of(const CsvText& csv, std::size_t column) {
  std::vector<double> numbers;
  numbers.reserve(csv.rows.size());
  for (std::size_t row = 0; row < csv.rows.size(); ++row) {
    const std::string& field = csv.rows[row][column];
    const char* const begin = field.data() + (field.starts_with('+') ? 1 : 0);
    const char* const end = field.data() + field.size();
    double value = 0;
    const auto [stopped, code] = std::from_chars(begin, end, value);
    if (code != std::errc{} || stopped != end) {
      return fail(Errc::bad_input,
                  fmt::format("{}: \"{}\" is no number", csv.place(row, column), field),
                  "expected a decimal number such as 4.3839");
    }
    if (!std::isfinite(value)) {
      return fail(Errc::not_finite, fmt::format("{}: \"{}\"", csv.place(row, column), field),
                  "expected a finite number");
    }
    numbers.push_back(value);
  }
  return numbers;
}

}  // namespace gyrocal::cli
