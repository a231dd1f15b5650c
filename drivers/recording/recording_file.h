#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "drivers/recording/recorded_event.h"
#include "drivers/recording/recording_database.h"

namespace gyrocal {

/// Appends the events of one run to a recording. Every `flush_every` what has come since is on the
/// disk, as a small piece; after a quarter of a megabyte the small pieces become one, which packs
/// better. A recording that cannot be written never stops a campaign: the trouble is kept for who
/// asks, and nothing more is recorded.
class RecordingWriter {
 public:
  /// @param flush_every  of the clock whose events are recorded: a second, times the time scale.
  [[nodiscard]] static Result<std::unique_ptr<RecordingWriter>> open(const std::string& path,
                                                                     const RecordedRun& run,
                                                                     Duration flush_every);
  RecordingWriter(const RecordingWriter&) = delete;
  RecordingWriter& operator=(const RecordingWriter&) = delete;
  ~RecordingWriter();  ///< packs and writes the rest

  void append(RecordedEvent event);
  void flush();
  [[nodiscard]] const std::optional<Error>& trouble() const { return trouble_; }

 private:
  RecordingWriter(RecordingDatabase database, std::int64_t run, Duration flush_every)
      : database_(std::move(database)), run_(run), flush_every_(flush_every) {}
  void merge();
  void give_up(const Error& why);

  RecordingDatabase database_;
  std::int64_t run_;
  Duration flush_every_;
  std::vector<RecordedEvent> events_;  ///< since the last merge
  std::size_t flushed_ = 0;            ///< of them, on the disk as small pieces
  std::size_t event_bytes_ = 0;
  std::int64_t seq_ = 0;        ///< of the next small piece
  std::int64_t merge_seq_ = 0;  ///< of the first small piece since the last merge
  Instant last_flush_{};
  std::optional<Error> trouble_;
};

/// Reads the events of one run, piece by piece.
class RecordingReader {
 public:
  [[nodiscard]] static Result<RecordingReader> open(const std::string& path, std::int64_t run);
  /// @return nothing after the last; bad_frame or storage for a damaged file.
  [[nodiscard]] Result<std::optional<RecordedEvent>> next();
  /// The time of the run's last event; its clock's zero if there is none.
  [[nodiscard]] Result<Instant> last();

 private:
  RecordingReader(RecordingDatabase database, std::int64_t run)
      : database_(std::move(database)), run_(run) {}

  RecordingDatabase database_;
  std::int64_t run_;
  std::int64_t next_seq_ = 0;
  std::vector<RecordedEvent> events_;
  std::size_t at_ = 0;
};

/// The runs a recording holds, in order.
[[nodiscard]] Result<std::vector<RecordedRun>> recorded_runs(const std::string& path);

}  // namespace gyrocal
