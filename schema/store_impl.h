#pragma once

#include <optional>
#include <string>
#include <vector>

#include "schema/sqlite.h"
#include "schema/store.h"
#include "schema/writer_lock.h"

namespace gyrocal {

struct Store::Impl {
  std::optional<WriterLock> lock;  ///< a writer's; let go after the database is closed
  Database database;
  std::optional<Statement> insert_sample;  ///< kept: 3000 rows a dwell

  /// Runs `body` as one transaction; an error says what was to be stored.
  Result<void> write(const std::string& what, const std::function<Result<void>()>& body);
};

/// Puts `while_doing` before what an error says.
template <class T>
Result<T> with_context(Result<T> result, const std::string& while_doing) {
  if (!result) result.error().what = while_doing + ": " + result.error().what;
  return result;
}

template <class Id>
[[nodiscard]] std::int64_t key(Id id) {
  return static_cast<std::int64_t>(id);
}

[[nodiscard]] inline std::string name_of(Axis axis) { return {letter(axis)}; }

/// Prepares, binds and calls `row` for every row.
template <class Row, class... Values>
Result<void> for_each_row(const Database& database, std::string_view sql, const Row& row,
                          const Values&... values) {
  auto statement = database.prepare(sql);
  if (!statement) return tl::unexpected(statement.error());
  statement->bind_all(values...);
  for (;;) {
    const auto more = statement->next();
    if (!more) return tl::unexpected(more.error());
    if (!*more) return {};
    row(*statement);
  }
}

/// Keys of the boards of a campaign, ascending.
[[nodiscard]] inline Result<std::vector<std::int64_t>> boards_of(const Database& database,
                                                                 CampaignId campaign) {
  std::vector<std::int64_t> boards;
  auto read = for_each_row(
      database, "SELECT id FROM board WHERE campaign_id = ? ORDER BY id",
      [&](const Statement& row) { boards.push_back(row.integer(0)); }, key(campaign));
  if (!read) return tl::unexpected(read.error());
  return boards;
}

/// Prepares, binds and runs one statement.
template <class... Values>
Result<void> run(const Database& database, std::string_view sql, const Values&... values) {
  auto statement = database.prepare(sql);
  if (!statement) return tl::unexpected(statement.error());
  return statement->run(values...);
}

}  // namespace gyrocal
