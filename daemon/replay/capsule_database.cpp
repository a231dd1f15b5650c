#include "daemon/replay/capsule_database.h"

#include <fmt/core.h>

#include <fstream>
#include <iterator>

#include "drivers/recording/compression.h"

namespace gyrocal::replay {
namespace {

constexpr char attached_as[] = "campaign.db";
constexpr int level = 9;
constexpr std::size_t bytes_max = std::size_t{1} << 30;

}  // namespace

Result<void> put_database(RecordingDatabase& recording, const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  const Bytes bytes{std::istreambuf_iterator<char>(file), {}};
  if (!file || bytes.empty()) return fail(Errc::storage, path + ": cannot be read");
  return recording.attach(attached_as, compressed(bytes, level));
}

Result<bool> take_database(RecordingDatabase& recording, const std::string& path) {
  const auto attached = recording.attachment(attached_as);
  if (!attached) return tl::unexpected(attached.error());
  if (!*attached) return false;
  const auto bytes = decompressed(**attached, bytes_max);
  if (!bytes) return tl::unexpected(bytes.error());
  std::ofstream file(path, std::ios::binary);
  file.write(reinterpret_cast<const char*>(bytes->data()),
             static_cast<std::streamsize>(bytes->size()));
  file.close();
  if (!file) {
    return fail(Errc::storage, fmt::format("{}: cannot be written", path),
                "set TMPDIR to a folder with room");
  }
  return true;
}

}  // namespace gyrocal::replay
