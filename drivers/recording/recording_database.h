#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "compensation/values/error.h"
#include "drivers/link.h"

struct sqlite3;

namespace gyrocal {

/// One run of a program in a recording.
struct RecordedRun {
  std::int64_t id = 0;
  std::int64_t started_utc_ns = 0;
  std::string software_version;
  std::string campaign_text;         ///< the campaign file as read
  std::string circumstances;         ///< what else the program began with, in its own words
  std::vector<std::string> streams;  ///< names of the links; number n is stream n + 1
  bool operator==(const RecordedRun&) const = default;
};

/// A piece of a run's events, packed and compressed.
struct RecordedPiece {
  std::int64_t seq = 0;
  std::int64_t first_ns = 0;  ///< time of the first event's begin, in the run's clock
  std::int64_t last_ns = 0;   ///< of the last one's end
  std::int64_t events = 0;
  Bytes data;
};

/// The file NAME.recording.db: SQLite, so that it survives what the results survive. The only file
/// of drivers/ that speaks SQL. Errors are of kind storage and name the file.
class RecordingDatabase {
 public:
  /// Opens, or makes, a recording to append to. mismatch if the file is none.
  [[nodiscard]] static Result<RecordingDatabase> open_to_write(const std::string& path);
  [[nodiscard]] static Result<RecordingDatabase> open_to_read(const std::string& path);

  /// @return the number of the new run.
  [[nodiscard]] Result<std::int64_t> add_run(const RecordedRun& run);
  [[nodiscard]] Result<void> add_piece(std::int64_t run, const RecordedPiece& piece);
  /// Puts `piece` in the place of all pieces of the run from its `seq` on, in one transaction.
  [[nodiscard]] Result<void> replace_tail(std::int64_t run, const RecordedPiece& piece);

  /// The latest last_ns of the run's pieces; 0 if there is none.
  [[nodiscard]] Result<std::int64_t> last_ns(std::int64_t run);

  /// Puts something into the file that is not of the links, under a name.
  [[nodiscard]] Result<void> attach(const std::string& name, const Bytes& data);
  [[nodiscard]] Result<std::optional<Bytes>> attachment(const std::string& name);

  /// Leaves one file, without -wal beside it, that can be read where nobody can write. If somebody
  /// reads just now, the log stays, as after a crash.
  void close_tidily();

  [[nodiscard]] Result<std::vector<RecordedRun>> runs();
  /// The first piece of the run with a seq of at least `from`; nothing after the last.
  [[nodiscard]] Result<std::optional<RecordedPiece>> piece(std::int64_t run, std::int64_t from);

 private:
  struct Close {
    void operator()(sqlite3* database) const noexcept;
  };
  class Query;
  using Handle = std::unique_ptr<sqlite3, Close>;
  RecordingDatabase(Handle handle, std::string path)
      : handle_(std::move(handle)), path_(std::move(path)) {}
  [[nodiscard]] static Result<RecordingDatabase> open(const std::string& path, int flags);
  [[nodiscard]] Result<void> execute(const char* sql);
  [[nodiscard]] Result<std::int64_t> pragma(const char* name);
  [[nodiscard]] Result<void> prepare_to_write();
  [[nodiscard]] Result<void> check_is_recording();
  [[nodiscard]] tl::unexpected<Error> failed(const std::string& doing) const;

  Handle handle_;
  std::string path_;
};

}  // namespace gyrocal
