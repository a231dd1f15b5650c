#include "drivers/recording/recording_database.h"

#include <fmt/format.h>
#include <sqlite3.h>

#include <utility>

namespace gyrocal {
namespace {

constexpr int application_id = 0x67795263;  // "gyRc"
constexpr int format_version = 1;
constexpr int busy_ms = 2000;

constexpr const char* schema = R"sql(
BEGIN IMMEDIATE;
CREATE TABLE run (                   -- one run of the daemon; a resumed campaign has several
  id               INTEGER PRIMARY KEY,
  started_utc_ns   INTEGER NOT NULL, -- since 1970
  software_version TEXT NOT NULL,
  campaign_text    TEXT NOT NULL,    -- the campaign file as read
  circumstances    TEXT NOT NULL     -- what else the daemon began with; daemon/runner/run_recording.h
) STRICT;
CREATE TABLE stream (                -- the links of a run; stream 0 is its clock
  run_id INTEGER NOT NULL REFERENCES run(id),
  number INTEGER NOT NULL CHECK (number >= 1),
  name   TEXT NOT NULL,
  PRIMARY KEY (run_id, number)
) STRICT, WITHOUT ROWID;
CREATE TABLE piece (                 -- events in order; drivers/recording/recorded_event.h
  run_id   INTEGER NOT NULL REFERENCES run(id),
  seq      INTEGER NOT NULL CHECK (seq >= 0),
  first_ns INTEGER NOT NULL,         -- of the run's clock
  last_ns  INTEGER NOT NULL,
  events   INTEGER NOT NULL CHECK (events > 0),
  data     BLOB NOT NULL,            -- zstd
  PRIMARY KEY (run_id, seq)
) STRICT;
CREATE TABLE attachment (            -- what a capsule brings along
  name TEXT PRIMARY KEY,
  data BLOB NOT NULL                 -- zstd
) STRICT, WITHOUT ROWID;
PRAGMA application_id = 1736004195;
PRAGMA user_version = 1;
COMMIT;
)sql";
static_assert(application_id == 1736004195);

const char* advice_for(int code) {
  switch (code) {
    case SQLITE_NOTADB:
      return "recordings are made by `gyrocal run` and gyrocald and are called NAME.recording.db";
    case SQLITE_CANTOPEN:
      return "does it exist, and may you read it?";
    case SQLITE_CORRUPT:
      return "the file is damaged; a copy, if there is one, may not be";
    case SQLITE_BUSY:
      return "another program writes to it";
    default:
      return "is the disk full?";
  }
}

}  // namespace

/// A prepared statement and its way through the rows.
class RecordingDatabase::Query {
 public:
  Query(RecordingDatabase& database, const char* sql) : database_(database) {
    sqlite3_prepare_v2(database.handle_.get(), sql, -1, &statement_, nullptr);
  }
  ~Query() { sqlite3_finalize(statement_); }
  Query(const Query&) = delete;
  Query& operator=(const Query&) = delete;

  Query& bind(std::int64_t value) {
    sqlite3_bind_int64(statement_, ++bound_, value);
    return *this;
  }
  Query& bind(const std::string& text) {
    sqlite3_bind_text(statement_, ++bound_, text.data(), static_cast<int>(text.size()),
                      SQLITE_TRANSIENT);
    return *this;
  }
  Query& bind(const Bytes& bytes) {
    sqlite3_bind_blob(statement_, ++bound_, bytes.data(), static_cast<int>(bytes.size()),
                      SQLITE_TRANSIENT);
    return *this;
  }
  /// @return whether there is a row.
  [[nodiscard]] Result<bool> next() {
    const int code = statement_ == nullptr ? SQLITE_ERROR : sqlite3_step(statement_);
    if (code == SQLITE_ROW) return true;
    if (code == SQLITE_DONE) return false;
    return database_.failed("read or write");
  }
  [[nodiscard]] Result<void> run() {
    const auto done = next();
    if (!done) return tl::unexpected(done.error());
    return {};
  }
  [[nodiscard]] std::int64_t integer(int column) const {
    return sqlite3_column_int64(statement_, column);
  }
  [[nodiscard]] Bytes bytes(int column) const {
    const auto* const begin =
        static_cast<const std::uint8_t*>(sqlite3_column_blob(statement_, column));
    return {begin, begin + sqlite3_column_bytes(statement_, column)};
  }
  [[nodiscard]] std::string text(int column) const {
    const Bytes characters = bytes(column);
    return {characters.begin(), characters.end()};
  }

 private:
  RecordingDatabase& database_;
  sqlite3_stmt* statement_ = nullptr;
  int bound_ = 0;
};

void RecordingDatabase::Close::operator()(sqlite3* database) const noexcept {
  sqlite3_close(database);
}

Result<RecordingDatabase> RecordingDatabase::open(const std::string& path, int flags) {
  sqlite3* raw = nullptr;
  const int code = sqlite3_open_v2(path.c_str(), &raw, flags, nullptr);
  RecordingDatabase database(Handle{raw}, path);
  if (code != SQLITE_OK) return database.failed("open");
  sqlite3_busy_timeout(raw, busy_ms);
  return database;
}

Result<RecordingDatabase> RecordingDatabase::open_to_write(const std::string& path) {
  auto database = open(path, SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE);
  if (!database) return database;
  if (const auto ready = database->prepare_to_write(); !ready) {
    return tl::unexpected(ready.error());
  }
  return database;
}

Result<RecordingDatabase> RecordingDatabase::open_to_read(const std::string& path) {
  auto database = open(path, SQLITE_OPEN_READONLY);
  if (!database) return database;
  if (const auto good = database->check_is_recording(); !good) {
    return tl::unexpected(good.error());
  }
  return database;
}

Result<void> RecordingDatabase::prepare_to_write() {
  const auto version = pragma("schema_version");
  if (!version) return tl::unexpected(version.error());
  const bool is_new = *version == 0;
  if (!is_new) {
    if (auto good = check_is_recording(); !good) return good;
  }
  // FULL: a power cut costs the last second, not what the operating system had not written yet.
  if (auto set = execute("PRAGMA journal_mode = WAL; PRAGMA synchronous = FULL;"); !set) return set;
  return is_new ? execute(schema) : Result<void>{};
}

Result<void> RecordingDatabase::check_is_recording() {
  const auto id = pragma("application_id");
  const auto version = pragma("user_version");
  if (!id) return tl::unexpected(id.error());
  if (!version) return tl::unexpected(version.error());
  if (*id == application_id && *version >= 1 && *version <= format_version) return {};
  if (*id == application_id && *version > format_version) {
    return fail(Errc::mismatch,
                fmt::format("{}: written by a newer gyrocal, in format {}; this one reads up to {}",
                            path_, *version, format_version),
                "use a gyrocal at least as new as the one that recorded it");
  }
  return fail(Errc::mismatch,
              fmt::format("{}: not a recording (application id {:#x}, version {}; expected {:#x})",
                          path_, *id, *version, application_id),
              "recordings stand beside their database and are called NAME.recording.db");
}

Result<std::int64_t> RecordingDatabase::pragma(const char* name) {
  Query query(*this, fmt::format("PRAGMA {}", name).c_str());
  const auto row = query.next();
  if (!row) return tl::unexpected(row.error());
  return query.integer(0);
}

Result<void> RecordingDatabase::execute(const char* sql) {
  if (sqlite3_exec(handle_.get(), sql, nullptr, nullptr, nullptr) == SQLITE_OK) return {};
  const auto error = failed("write");
  sqlite3_exec(handle_.get(), "ROLLBACK", nullptr, nullptr, nullptr);  // if one is open
  return error;
}

Result<std::int64_t> RecordingDatabase::add_run(const RecordedRun& run) {
  if (const auto begun = execute("BEGIN IMMEDIATE"); !begun) return tl::unexpected(begun.error());
  Query insert(*this,
               "INSERT INTO run (started_utc_ns, software_version, campaign_text, circumstances) "
               "VALUES (?,?,?,?)");
  auto done = insert.bind(run.started_utc_ns)
                  .bind(run.software_version)
                  .bind(run.campaign_text)
                  .bind(run.circumstances)
                  .run();
  const std::int64_t id = sqlite3_last_insert_rowid(handle_.get());
  for (std::size_t i = 0; done && i < run.streams.size(); ++i) {
    Query stream(*this, "INSERT INTO stream (run_id, number, name) VALUES (?,?,?)");
    done = stream.bind(id).bind(static_cast<std::int64_t>(i + 1)).bind(run.streams[i]).run();
  }
  const auto ended = execute(done ? "COMMIT" : "ROLLBACK");
  if (!done) return tl::unexpected(done.error());
  if (!ended) return tl::unexpected(ended.error());
  return id;
}

Result<void> RecordingDatabase::add_piece(std::int64_t run, const RecordedPiece& piece) {
  Query insert(*this,
               "INSERT INTO piece (run_id, seq, first_ns, last_ns, events, data) "
               "VALUES (?,?,?,?,?,?)");
  return insert.bind(run)
      .bind(piece.seq)
      .bind(piece.first_ns)
      .bind(piece.last_ns)
      .bind(piece.events)
      .bind(piece.data)
      .run();
}

Result<void> RecordingDatabase::replace_tail(std::int64_t run, const RecordedPiece& piece) {
  if (auto begun = execute("BEGIN IMMEDIATE"); !begun) return begun;
  Query remove(*this, "DELETE FROM piece WHERE run_id = ? AND seq >= ?");
  auto done = remove.bind(run).bind(piece.seq).run();
  if (done) done = add_piece(run, piece);
  const auto ended = execute(done ? "COMMIT" : "ROLLBACK");
  return done ? ended : done;
}

Result<std::int64_t> RecordingDatabase::last_ns(std::int64_t run) {
  Query query(*this, "SELECT coalesce(max(last_ns), 0) FROM piece WHERE run_id = ?");
  const auto row = query.bind(run).next();
  if (!row) return tl::unexpected(row.error());
  return query.integer(0);
}

Result<void> RecordingDatabase::attach(const std::string& name, const Bytes& data) {
  return Query(*this, "INSERT INTO attachment (name, data) VALUES (?,?)")
      .bind(name)
      .bind(data)
      .run();
}

Result<std::optional<Bytes>> RecordingDatabase::attachment(const std::string& name) {
  Query query(*this, "SELECT data FROM attachment WHERE name = ?");
  const auto row = query.bind(name).next();
  if (!row) return tl::unexpected(row.error());
  if (!*row) return std::optional<Bytes>{};
  return query.bytes(0);
}

void RecordingDatabase::close_tidily() {
  static_cast<void>(execute("PRAGMA journal_mode = DELETE"));  // best effort: nothing is lost
}

Result<std::vector<RecordedRun>> RecordingDatabase::runs() {
  std::vector<RecordedRun> runs;
  Query query(*this,
              "SELECT id, started_utc_ns, software_version, campaign_text, circumstances "
              "FROM run ORDER BY id");
  for (;;) {
    const auto row = query.next();
    if (!row) return tl::unexpected(row.error());
    if (!*row) return runs;
    runs.push_back(
        {query.integer(0), query.integer(1), query.text(2), query.text(3), query.text(4), {}});
    Query streams(*this, "SELECT name FROM stream WHERE run_id = ? ORDER BY number");
    streams.bind(runs.back().id);
    for (;;) {
      const auto stream = streams.next();
      if (!stream) return tl::unexpected(stream.error());
      if (!*stream) break;
      runs.back().streams.push_back(streams.text(0));
    }
  }
}

Result<std::optional<RecordedPiece>> RecordingDatabase::piece(std::int64_t run, std::int64_t from) {
  Query query(*this,
              "SELECT seq, first_ns, last_ns, events, data FROM piece "
              "WHERE run_id = ? AND seq >= ? ORDER BY seq LIMIT 1");
  const auto row = query.bind(run).bind(from).next();
  if (!row) return tl::unexpected(row.error());
  if (!*row) return std::optional<RecordedPiece>{};
  return RecordedPiece{query.integer(0), query.integer(1), query.integer(2), query.integer(3),
                       query.bytes(4)};
}

tl::unexpected<Error> RecordingDatabase::failed(const std::string& doing) const {
  return fail(Errc::storage, fmt::format("{}: {}: {}", path_, doing, sqlite3_errmsg(handle_.get())),
              advice_for(sqlite3_errcode(handle_.get())));
}

}  // namespace gyrocal
