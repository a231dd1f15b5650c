#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include "compensation/values/error.h"

struct sqlite3;
struct sqlite3_stmt;

namespace gyrocal {

/// One value: NULL, a whole number, a number, a text.
using Cell = std::variant<std::monostate, std::int64_t, double, std::string>;

/// A prepared statement. Parameters and columns count from 0. NaN is bound as NULL and NULL is read
/// as NaN: both stand for "not measured".
class Statement {
 public:
  void bind(int parameter, std::int64_t value);
  void bind(int parameter, int value) { bind(parameter, std::int64_t{value}); }
  void bind(int parameter, bool value) { bind(parameter, std::int64_t{value}); }
  void bind(int parameter, double value);
  void bind(int parameter, std::string_view value);
  void bind(int parameter, const std::string& value) { bind(parameter, std::string_view(value)); }
  void bind(int parameter, const char* value) { bind(parameter, std::string_view(value)); }
  void bind_null(int parameter);
  template <class T>
  void bind(int parameter, const std::optional<T>& value) {
    value ? bind(parameter, *value) : bind_null(parameter);
  }
  template <class... Values>
  void bind_all(const Values&... values) {
    int parameter = 0;
    (bind(parameter++, values), ...);
  }

  /// Binds all, runs to the end, is ready for the next run.
  template <class... Values>
  [[nodiscard]] Result<void> run(const Values&... values) {
    bind_all(values...);
    return run_bound();
  }
  [[nodiscard]] Result<void> run_bound();

  /// @return true: a row stands ready; false: no more, and the statement starts anew.
  [[nodiscard]] Result<bool> next();
  [[nodiscard]] std::int64_t integer(int column) const;
  [[nodiscard]] double real(int column) const;
  [[nodiscard]] std::string text(int column) const;
  [[nodiscard]] bool is_null(int column) const;
  [[nodiscard]] Cell cell(int column) const;
  [[nodiscard]] int columns() const;
  [[nodiscard]] std::string column_name(int column) const;
  /// Ready for the next bind_all, whatever happened.
  void reset();

 private:
  friend class Database;
  struct Finalize {
    void operator()(sqlite3_stmt* statement) const noexcept;
  };
  explicit Statement(sqlite3_stmt* statement) : statement_(statement) {}
  std::unique_ptr<sqlite3_stmt, Finalize> statement_;
};

enum class OpenMode {
  read_only,
  immutable,  ///< read-only where nobody can write, the folder neither: no locks, no -wal file
  read_write_create,
};

/// A SQLite connection, used by one thread at a time. Errors carry the path and SQLite's own words;
/// codes: busy (somebody else writes), bad_input (a constraint refused a row), mismatch (no
/// database), storage (the rest).
class Database {
 public:
  [[nodiscard]] static Result<Database> open(const std::string& path, OpenMode mode);

  /// Runs a script of statements; any rows are dropped.
  [[nodiscard]] Result<void> execute(const std::string& sql) const;
  [[nodiscard]] Result<Statement> prepare(std::string_view sql) const;
  /// The first column of the first row.
  [[nodiscard]] Result<std::int64_t> integer(std::string_view sql) const;
  [[nodiscard]] std::int64_t last_insert_id() const;
  [[nodiscard]] bool read_only() const;        ///< also where SQLite found no permission to write
  [[nodiscard]] const std::string& path() const { return path_; }

  /// Runs `body` in one transaction that takes the writer's place at once: committed to disk if it
  /// returns without error, undone else.
  [[nodiscard]] Result<void> transaction(const std::function<Result<void>()>& body) const;
  /// Runs `body`, which only reads, over the database as it stands at its first reading, whatever
  /// others write meanwhile. Cheaper than reading statement by statement: locked once.
  [[nodiscard]] Result<void> snapshot(const std::function<Result<void>()>& body) const;

 private:
  [[nodiscard]] Result<void> between(const char* begin,
                                     const std::function<Result<void>()>& body) const;
  struct Close {
    void operator()(sqlite3* connection) const noexcept;
  };
  std::unique_ptr<sqlite3, Close> connection_;
  std::string path_;
};

}  // namespace gyrocal
