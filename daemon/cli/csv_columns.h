#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "compensation/values/error.h"

namespace gyrocal::cli {

/// A CSV file as text: one header row of names, then rows of as many fields. A byte-order mark,
/// CRLF, blanks around fields and blank lines are taken; quoting is not.
struct CsvText {
  std::string source;  ///< for messages: the path, or "standard input"
  std::vector<std::string> header;
  std::vector<std::vector<std::string>> rows;  ///< each as long as the header
  std::vector<int> line;                       ///< of each row, from 1

  /// "drift.csv line 7, column 2 (zero_drift_dps)".
  [[nodiscard]] std::string place(std::size_t row, std::size_t column) const;
};

/// Reads a whole file, or standard input for "-".
/// @return bad_input with the system's reason.
[[nodiscard]] Result<std::string> read_text(const std::string& path);

/// @return bad_input naming source, line and column: a name twice in the header, a row that is
///         shorter or longer (a trailing comma), no rows.
[[nodiscard]] Result<CsvText> parse_csv(std::string_view text, std::string source);

/// Where the column stands. @return bad_input with what the header holds instead.
[[nodiscard]] Result<std::size_t> column_named(const CsvText& csv, std::string_view name);

/// One column as finite numbers. @return bad_input, not_finite with the place.
[[nodiscard]] Result<std::vector<double>> numbers_of(const CsvText& csv, std::size_t column);

}  // namespace gyrocal::cli
