#pragma once

#include <optional>
#include <string>
#include <vector>

#include "compensation/values/error.h"

namespace gyrocal {

/// A column of a table or view, as `.schema` tells it.
struct ColumnInfo {
  std::string name;
  std::string type;        ///< "INTEGER", "REAL", "TEXT"; empty: a computed column of a view
  bool nullable = true;    ///< tables only: NULL stands for "not measured"
  bool is_key = false;     ///< part of the primary key
  std::string references;  ///< "board(id)"; empty: no foreign key
  std::string comment;     ///< what it means; empty for a row's number `id`
};

/// A table or view of the present schema.
struct TableInfo {
  std::string name;
  bool is_view = false;
  std::string comment;
  std::vector<ColumnInfo> columns;
};

struct Catalogue {
  int version = 0;                ///< of the schema
  std::vector<TableInfo> tables;  ///< in the order of the migrations, then the views by name
};

/// The present schema as this program creates it, with the comments of its SQL. Opens no file.
[[nodiscard]] Result<Catalogue> catalogue();

}  // namespace gyrocal
