#include "drivers/recording/recording_file.h"

#include <fmt/format.h>

#include <span>
#include <utility>

#include "drivers/recording/compression.h"

namespace gyrocal {
namespace {

constexpr std::size_t merge_bytes = std::size_t{256} << 10;
constexpr std::size_t piece_bytes_max = std::size_t{64} << 20;
constexpr std::size_t event_overhead_bytes = 8;  // its numbers, about
constexpr int small_piece_level = 1;
constexpr int merged_piece_level = 9;

RecordedPiece piece_of(std::span<const RecordedEvent> events, std::int64_t seq, int level) {
  return {seq, events.front().begin.time_since_epoch().count(),
          events.back().end.time_since_epoch().count(), static_cast<std::int64_t>(events.size()),
          compressed(encode_events(events), level)};
}

}  // namespace

Result<std::unique_ptr<RecordingWriter>> RecordingWriter::open(const std::string& path,
                                                               const RecordedRun& run,
                                                               Duration flush_every) {
  auto database = RecordingDatabase::open_to_write(path);
  if (!database) return tl::unexpected(database.error());
  const auto id = database->add_run(run);
  if (!id) return tl::unexpected(id.error());
  return std::unique_ptr<RecordingWriter>(
      new RecordingWriter(std::move(*database), *id, flush_every));
}

RecordingWriter::~RecordingWriter() {
  if (!trouble_ && !events_.empty()) merge();
  if (!trouble_) database_.close_tidily();
}

void RecordingWriter::append(RecordedEvent event) {
  if (trouble_) return;
  const Instant now = event.end;
  event_bytes_ += event.sent.size() + event.received.size() + event_overhead_bytes;
  events_.push_back(std::move(event));
  if (event_bytes_ >= merge_bytes) {
    merge();
  } else if (now - last_flush_ >= flush_every_) {
    flush();
  } else {
    return;
  }
  last_flush_ = now;
}

void RecordingWriter::flush() {
  if (trouble_ || flushed_ == events_.size()) return;
  const auto fresh = std::span(events_).subspan(flushed_);
  const auto added = database_.add_piece(run_, piece_of(fresh, seq_, small_piece_level));
  if (!added) return give_up(added.error());
  ++seq_;
  flushed_ = events_.size();
}

void RecordingWriter::merge() {
  const auto merged =
      database_.replace_tail(run_, piece_of(events_, merge_seq_, merged_piece_level));
  if (!merged) return give_up(merged.error());
  seq_ = ++merge_seq_;
  events_.clear();
  flushed_ = 0;
  event_bytes_ = 0;
}

void RecordingWriter::give_up(const Error& why) {
  trouble_ = why;
  events_ = {};
}

Result<RecordingReader> RecordingReader::open(const std::string& path, std::int64_t run) {
  auto database = RecordingDatabase::open_to_read(path);
  if (!database) return tl::unexpected(database.error());
  return RecordingReader(std::move(*database), run);
}

Result<std::optional<RecordedEvent>> RecordingReader::next() {
  while (at_ == events_.size()) {
    const auto piece = database_.piece(run_, next_seq_);
    if (!piece) return tl::unexpected(piece.error());
    if (!*piece) return std::optional<RecordedEvent>{};
    if ((*piece)->seq != next_seq_) {
      return fail(Errc::bad_frame,
                  fmt::format("piece {} of run {} of the recording is missing", next_seq_, run_),
                  "the file is damaged");
    }
    const auto unpacked = decompressed((*piece)->data, piece_bytes_max);
    if (!unpacked) return tl::unexpected(unpacked.error());
    auto events = decode_events(*unpacked);
    if (!events) return tl::unexpected(events.error());
    if (events->size() != static_cast<std::size_t>((*piece)->events)) {
      return fail(Errc::bad_frame,
                  fmt::format("piece {} of the recording holds {} events, {} were written",
                              (*piece)->seq, events->size(), (*piece)->events),
                  "the file is damaged");
    }
    events_ = std::move(*events);
    at_ = 0;
    next_seq_ = (*piece)->seq + 1;
  }
  return std::optional(std::move(events_[at_++]));
}

Result<Instant> RecordingReader::last() {
  const auto last_ns = database_.last_ns(run_);
  if (!last_ns) return tl::unexpected(last_ns.error());
  return Instant{Duration{*last_ns}};
}

Result<std::vector<RecordedRun>> recorded_runs(const std::string& path) {
  auto database = RecordingDatabase::open_to_read(path);
  if (!database) return tl::unexpected(database.error());
  return database->runs();
}

}  // namespace gyrocal
