#include "schema/catalogue.h"

#include <fmt/core.h>

#include <regex>
#include <sstream>

#include "schema/migrate.h"

namespace gyrocal {
namespace {

/// The comment of a column in its table's or view's SQL: "/* ... */" behind the name where ALTER
/// TABLE put it (SQLite keeps no trailing comment there), else the end of the line that defines it.
std::string comment_of(const std::string& sql, const std::string& column) {
  const std::regex inside("[ ,(]" + column + " /\\* (.*?) \\*/");
  std::smatch found;
  if (std::regex_search(sql, found, inside)) return found[1];
  const std::regex table_line("^  " + column + " .*?  -- (.*)$");
  const std::regex view_line("^.*[ .]" + column + ",?  -- (.*)$");
  std::istringstream lines(sql);
  for (std::string line; std::getline(lines, line);) {
    if (std::regex_match(line, found, table_line)) return found[1];
    if (std::regex_match(line, found, view_line)) return found[1];
  }
  return {};
}

/// Each row as texts.
Result<std::vector<std::vector<std::string>>> rows(const Database& database, const std::string& sql,
                                                   const std::string& parameter) {
  auto statement = database.prepare(sql);
  if (!statement) return tl::unexpected(statement.error());
  statement->bind(0, parameter);
  std::vector<std::vector<std::string>> all;
  for (;;) {
    const auto more = statement->next();
    if (!more) return tl::unexpected(more.error());
    if (!*more) return all;
    auto& row = all.emplace_back();
    for (int i = 0; i < statement->columns(); ++i) row.push_back(statement->text(i));
  }
}

Result<std::vector<ColumnInfo>> columns_of(const Database& database, const std::string& table,
                                           const std::string& sql) {
  const auto found = rows(database,
                          "SELECT info.name, info.type, info.\"notnull\", info.pk, "
                          "coalesce((SELECT \"table\" || '(' || \"to\" || ')' FROM "
                          "pragma_foreign_key_list(?1) AS key WHERE key.\"from\" = info.name AND "
                          "\"to\" = 'id'), (SELECT \"table\" || '(' || \"to\" || ')' FROM "
                          "pragma_foreign_key_list(?1) AS key WHERE key.\"from\" = info.name), '') "
                          "FROM pragma_table_info(?1) AS info",
                          table);
  if (!found) return tl::unexpected(found.error());
  std::vector<ColumnInfo> columns;
  for (const auto& row : *found) {
    const bool key = row[3] != "0";
    columns.push_back(
        {row[0], row[1], row[2] == "0" && !key, key, row[4], comment_of(sql, row[0])});
  }
  return columns;
}

}  // namespace

Result<Catalogue> catalogue() {
  const auto database = Database::open(":memory:", OpenMode::read_write_create);
  if (!database) return tl::unexpected(database.error());
  const auto made = migrate(*database, embedded_migrations(), embedded_views());
  if (!made) return tl::unexpected(made.error());
  const auto found = rows(*database,
                          "SELECT name, type, sql FROM sqlite_schema WHERE type IN ('table', "
                          "'view') AND name NOT LIKE ?1 ORDER BY type, rowid",
                          "sqlite%");
  if (!found) return tl::unexpected(found.error());
  Catalogue whole{newest_version(embedded_migrations()), {}};
  for (const auto& row : *found) {
    auto columns = columns_of(*database, row[0], row[2]);
    if (!columns) return tl::unexpected(columns.error());
    const std::string first_line = row[2].substr(0, row[2].find('\n'));
    const auto dashes = first_line.find("-- ");
    whole.tables.push_back({row[0], row[1] == "view",
                            dashes == std::string::npos ? "" : first_line.substr(dashes + 3),
                            std::move(*columns)});
  }
  return whole;
}

}  // namespace gyrocal
