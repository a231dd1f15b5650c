#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "compensation/values/error.h"

namespace gyrocal {

/// A column to be read from a CSV file.
struct CsvColumn {
  std::string_view name;
  bool required = false;  ///< in the header and in every row
};

/// The rows of a CSV text of numbers, read once and forwards; columns stand in any order and are
/// found by name, others are passed over. Takes a byte-order mark, CRLF and blank lines at the end;
/// no quoting. Empty fields are `missing`.
class CsvRows {
 public:
  /// Reads the header; `text` must outlive this. `source` names the file in messages.
  /// @return bad_input: no header, a name twice, a required column absent, a near miss of a name.
  [[nodiscard]] static Result<CsvRows> start(std::string_view text, std::string source,
                                             std::span<const CsvColumn> columns);

  /// Reads one row into `values`, one for each column in the order of start().
  /// @return false at the end; bad_input or not_finite with file, line and column.
  [[nodiscard]] Result<bool> next(std::span<double> values);

  /// The line of the row read last, from 1.
  [[nodiscard]] int line() const { return line_; }
  /// "samples.csv line 7, column 2 (seq)" for the row read last.
  [[nodiscard]] std::string place(std::size_t column) const;
  /// bad_input at a column of the row read last: "PLACE: WHAT".
  [[nodiscard]] tl::unexpected<Error> refuse(std::size_t column, const std::string& what) const;
  /// A whole number of the row read last, 0 to 2^31 - 1.
  [[nodiscard]] Result<std::int64_t> whole(std::size_t column, double value) const;

 private:
  CsvRows(std::string_view text, std::string source, std::span<const CsvColumn> columns);
  [[nodiscard]] Result<void> read_header();
  [[nodiscard]] Result<double> parse(std::size_t column, std::string_view field) const;
  [[nodiscard]] std::string_view take_line();
  [[nodiscard]] tl::unexpected<Error> wrong_width(std::size_t fields) const;

  std::string_view rest_;
  std::string source_;
  std::vector<CsvColumn> columns_;
  std::vector<int> wanted_;    ///< for each field of the file: its column, or -1
  std::vector<int> field_of_;  ///< for each column: its field, or -1
  int line_ = 0;
};

}  // namespace gyrocal
