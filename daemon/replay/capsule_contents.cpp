#include "daemon/replay/capsule_contents.h"

#include <fmt/core.h>

#include <fstream>
#include <iterator>

#include "drivers/recording/compression.h"

namespace gyrocal::replay {
namespace {

constexpr char database_name[] = "campaign.db";
constexpr char note_name[] = "note";
constexpr int level = 9;
constexpr std::size_t database_bytes_max = std::size_t{1} << 30;
constexpr std::size_t note_bytes_max = 4096;

Result<std::optional<Bytes>> unpacked(RecordingDatabase& recording, const char* name,
                                      std::size_t bytes_max) {
  const auto attached = recording.attachment(name);
  if (!attached) return tl::unexpected(attached.error());
  if (!*attached) return std::optional<Bytes>{};
  auto bytes = decompressed(**attached, bytes_max);
  if (!bytes) return tl::unexpected(bytes.error());
  return std::optional(std::move(*bytes));
}

}  // namespace

Result<void> put_contents(RecordingDatabase& recording, const std::string& path,
                          const std::string& note) {
  std::ifstream file(path, std::ios::binary);
  const Bytes bytes{std::istreambuf_iterator<char>(file), {}};
  if (!file || bytes.empty()) return fail(Errc::storage, path + ": cannot be read");
  if (auto put = recording.attach(database_name, compressed(bytes, level)); !put) return put;
  return recording.attach(note_name, compressed(Bytes{note.begin(), note.end()}, level));
}

Result<std::optional<std::string>> take_contents(RecordingDatabase& recording,
                                                 const std::string& path) {
  const auto note = unpacked(recording, note_name, note_bytes_max);
  if (!note) return tl::unexpected(note.error());
  const auto bytes = unpacked(recording, database_name, database_bytes_max);
  if (!bytes) return tl::unexpected(bytes.error());
  if (!*note || !*bytes) return std::optional<std::string>{};
  std::ofstream file(path, std::ios::binary);
  file.write(reinterpret_cast<const char*>((*bytes)->data()),
             static_cast<std::streamsize>((*bytes)->size()));
  file.close();
  if (!file) {
    return fail(Errc::storage, fmt::format("{}: cannot be written", path),
                "set TMPDIR to a folder with room");
  }
  return std::optional<std::string>({(*note)->begin(), (*note)->end()});
}

}  // namespace gyrocal::replay
