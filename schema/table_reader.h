#pragma once

#include <string>
#include <vector>

#include "compensation/values/error.h"
#include "schema/sqlite.h"

namespace gyrocal {

/// A table or view of the database row by row, as it stands, for export and summaries.
class TableReader {
 public:
  /// @return unknown_name with the nearest name and the list; the errors of a database that is none
  ///   of ours.
  [[nodiscard]] static Result<TableReader> open(const std::string& path, const std::string& table);
  [[nodiscard]] std::vector<std::string> columns() const;
  /// @return false at the end.
  [[nodiscard]] Result<bool> next(std::vector<Cell>& row);

 private:
  TableReader(Database database, Statement rows)
      : database_(std::move(database)), rows_(std::move(rows)) {}
  Database database_;
  Statement rows_;
};

}  // namespace gyrocal
