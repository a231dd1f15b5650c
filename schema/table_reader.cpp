#include "schema/table_reader.h"

#include <fmt/core.h>

#include <algorithm>

#include "compensation/values/nearest_name.h"
#include "schema/open_database.h"

namespace gyrocal {
namespace {

Result<std::vector<std::string>> tables_and_views(const Database& database) {
  auto names = database.prepare(
      "SELECT name FROM sqlite_schema WHERE type IN ('table', 'view') AND name NOT LIKE 'sqlite%' "
      "ORDER BY name");
  if (!names) return tl::unexpected(names.error());
  std::vector<std::string> found;
  for (;;) {
    const auto more = names->next();
    if (!more) return tl::unexpected(more.error());
    if (!*more) return found;
    found.push_back(names->text(0));
  }
}

}  // namespace

Result<TableReader> TableReader::open(const std::string& path, const std::string& table) {
  auto database = open_to_read(path);
  if (!database) return tl::unexpected(database.error());
  const auto names = tables_and_views(*database);
  if (!names) return tl::unexpected(names.error());
  if (std::find(names->begin(), names->end(), table) == names->end()) {
    const std::vector<std::string_view> known(names->begin(), names->end());
    std::string list;
    for (const auto& name : *names) list += (list.empty() ? "" : " ") + name;
    return fail(Errc::unknown_name, fmt::format("{}: no table or view \"{}\"", path, table),
                is_meant(table, known) + "there are: " + list);
  }
  auto rows = database->prepare(fmt::format("SELECT * FROM \"{}\"", table));
  if (!rows) return tl::unexpected(rows.error());
  return TableReader(std::move(*database), std::move(*rows));
}

std::vector<std::string> TableReader::columns() const {
  std::vector<std::string> names;
  for (int i = 0; i < rows_.columns(); ++i) names.push_back(rows_.column_name(i));
  return names;
}

Result<bool> TableReader::next(std::vector<Cell>& row) {
  const auto more = rows_.next();
  if (!more || !*more) return more;
  row.clear();
  for (int i = 0; i < rows_.columns(); ++i) row.push_back(rows_.cell(i));
  return true;
}

}  // namespace gyrocal
