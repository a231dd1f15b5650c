#include "schema/sqlite.h"

#include <fmt/core.h>
#include <sqlite3.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "compensation/values/assert.h"

namespace gyrocal {
namespace {

struct Kind {
  Errc code;
  const char* advice;
};

Kind kind_of(int sqlite_code) {
  switch (sqlite_code & 0xFF) {
    case SQLITE_BUSY:
    case SQLITE_LOCKED:
      return {Errc::busy, "somebody else is writing to it: close that program or shell"};
    case SQLITE_CONSTRAINT:
    case SQLITE_TOOBIG:
    case SQLITE_MISMATCH:
      return {Errc::bad_input, ""};
    case SQLITE_NOTADB:
      return {Errc::mismatch, "give the name of a gyrocal database, or of a new file"};
    case SQLITE_FULL:
      return {Errc::storage, "free some disk space; what was stored before is intact"};
    case SQLITE_READONLY:
    case SQLITE_PERM:
    case SQLITE_AUTH:
      return {Errc::storage, "check the permissions of the file and its folder"};
    case SQLITE_CANTOPEN:
      return {Errc::storage, "check the path and its permissions"};
    case SQLITE_CORRUPT:
      return {Errc::storage, "`gyrocal db check` says what is damaged; take the latest backup"};
    case SQLITE_IOERR:
      return {Errc::storage, "check disk and file system; what was stored before is intact"};
    default:
      return {Errc::storage, ""};
  }
}

std::string immutable_uri(const std::string& path) {
  std::string uri = "file:";
  for (const char c : path) {
    uri += c == '%' || c == '?' || c == '#' ? fmt::format("%{:02X}", static_cast<unsigned>(c))
                                            : std::string(1, c);
  }
  return uri + "?immutable=1";
}

tl::unexpected<Error> failed(sqlite3* connection, int code) {
  const Kind kind = kind_of(code);
  const char* path = sqlite3_db_filename(connection, "main");
  // The message is that of the latest call; a code that is not its own speaks for itself.
  const char* words = sqlite3_errcode(connection) == (code & 0xFF) ? sqlite3_errmsg(connection)
                                                                   : sqlite3_errstr(code);
  return fail(kind.code, fmt::format("{}: {}", path != nullptr ? path : "database", words),
              kind.advice);
}

}  // namespace

void Statement::Finalize::operator()(sqlite3_stmt* statement) const noexcept {
  sqlite3_finalize(statement);
}

void Statement::bind(int parameter, std::int64_t value) {
  GYROCAL_ASSERT(sqlite3_bind_int64(statement_.get(), parameter + 1, value) == SQLITE_OK);
}

void Statement::bind(int parameter, double value) {
  GYROCAL_ASSERT(sqlite3_bind_double(statement_.get(), parameter + 1, value) == SQLITE_OK);
}

void Statement::bind(int parameter, std::string_view value) {
  GYROCAL_ASSERT(sqlite3_bind_text64(statement_.get(), parameter + 1, value.data(), value.size(),
                                     SQLITE_TRANSIENT, SQLITE_UTF8) == SQLITE_OK);
}

void Statement::bind_null(int parameter) {
  GYROCAL_ASSERT(sqlite3_bind_null(statement_.get(), parameter + 1) == SQLITE_OK);
}

Result<void> Statement::run_bound() {
  for (;;) {
    const auto row = next();
    if (!row) return tl::unexpected(row.error());
    if (!*row) return {};
  }
}

Result<bool> Statement::next() {
  const int code = sqlite3_step(statement_.get());
  if (code == SQLITE_ROW) return true;
  if (code == SQLITE_DONE) {
    sqlite3_reset(statement_.get());
    return false;
  }
  auto error = failed(sqlite3_db_handle(statement_.get()), code);
  sqlite3_reset(statement_.get());
  return error;
}

std::int64_t Statement::integer(int column) const {
  return sqlite3_column_int64(statement_.get(), column);
}

double Statement::real(int column) const {
  return is_null(column) ? std::numeric_limits<double>::quiet_NaN()
                         : sqlite3_column_double(statement_.get(), column);
}

std::string Statement::text(int column) const {
  const auto* bytes = reinterpret_cast<const char*>(sqlite3_column_text(statement_.get(), column));
  const auto size = static_cast<std::size_t>(sqlite3_column_bytes(statement_.get(), column));
  return bytes == nullptr ? std::string() : std::string(bytes, size);
}

bool Statement::is_null(int column) const {
  return sqlite3_column_type(statement_.get(), column) == SQLITE_NULL;
}

Cell Statement::cell(int column) const {
  switch (sqlite3_column_type(statement_.get(), column)) {
    case SQLITE_NULL:
      return {};
    case SQLITE_INTEGER:
      return integer(column);
    case SQLITE_FLOAT:
      return real(column);
    default:
      return text(column);
  }
}

int Statement::columns() const { return sqlite3_column_count(statement_.get()); }

std::string Statement::column_name(int column) const {
  return sqlite3_column_name(statement_.get(), column);
}

void Statement::reset() { sqlite3_reset(statement_.get()); }

void Database::Close::operator()(sqlite3* connection) const noexcept {
  sqlite3_close_v2(connection);
}

Result<Database> Database::open(const std::string& path, OpenMode mode) {
  const int flags = mode == OpenMode::read_write_create ? SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE
                                                        : SQLITE_OPEN_READONLY;
  const std::string name = mode == OpenMode::immutable ? immutable_uri(path) : path;
  sqlite3* raw = nullptr;
  const int code = sqlite3_open_v2(
      name.c_str(), &raw,
      flags | SQLITE_OPEN_NOMUTEX | (mode == OpenMode::immutable ? SQLITE_OPEN_URI : 0), nullptr);
  Database database;
  database.connection_.reset(raw);
  database.path_ = path;
  if (code != SQLITE_OK) {
    const Kind kind = kind_of(code);
    const int reason = raw == nullptr ? 0 : sqlite3_system_errno(raw);
    return fail(kind.code,
                fmt::format("open {}: {}", path,
                            reason != 0 ? std::strerror(reason) : sqlite3_errstr(code)),
                kind.advice);
  }
  sqlite3_extended_result_codes(raw, 1);
  sqlite3_busy_timeout(raw, 5000);  // a reader's checkpoint or a short write of another program
  return database;
}

Result<void> Database::execute(const std::string& sql) const {
  const int code = sqlite3_exec(connection_.get(), sql.c_str(), nullptr, nullptr, nullptr);
  if (code != SQLITE_OK) return failed(connection_.get(), code);
  return {};
}

Result<Statement> Database::prepare(std::string_view sql) const {
  sqlite3_stmt* statement = nullptr;
  const int code = sqlite3_prepare_v2(connection_.get(), sql.data(), static_cast<int>(sql.size()),
                                      &statement, nullptr);
  if (code != SQLITE_OK) return failed(connection_.get(), code);
  return Statement(statement);
}

Result<std::int64_t> Database::integer(std::string_view sql) const {
  auto statement = prepare(sql);
  if (!statement) return tl::unexpected(statement.error());
  const auto row = statement->next();
  if (!row) return tl::unexpected(row.error());
  return *row ? statement->integer(0) : 0;
}

std::int64_t Database::last_insert_id() const {
  return sqlite3_last_insert_rowid(connection_.get());
}

bool Database::read_only() const { return sqlite3_db_readonly(connection_.get(), "main") == 1; }

Result<void> Database::transaction(const std::function<Result<void>()>& body) const {
  return between("BEGIN IMMEDIATE", body);
}

Result<void> Database::snapshot(const std::function<Result<void>()>& body) const {
  return between("BEGIN DEFERRED", body);
}

Result<void> Database::between(const char* begin, const std::function<Result<void>()>& body) const {
  if (auto begun = execute(begin); !begun) return begun;
  auto done = body();
  if (done) done = execute("COMMIT");
  if (!done && sqlite3_get_autocommit(connection_.get()) == 0) {
    // Some failures roll back by themselves; for the others this cannot fail in a way that leaves
    // the transaction open.
    sqlite3_exec(connection_.get(), "ROLLBACK", nullptr, nullptr, nullptr);
    GYROCAL_ASSERT(sqlite3_get_autocommit(connection_.get()) != 0);
  }
  return done;
}

}  // namespace gyrocal
