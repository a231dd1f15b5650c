/// Session directories with one of their files mutated: each is refused with file and place, or
/// read as one that reads back to the same bits when written.

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "compensation/values/assert.h"
#include "schema/session/session_csv.h"
#include "tests/fuzz/loop.h"
#include "tests/schema/small_session.h"

using namespace gyrocal;

namespace {

constexpr const char* names[] = {"session.json", "monitor.csv", "samples.csv"};

/// A folder in memory where there is one: each input is written before it is read.
class Folder {
 public:
  Folder() {
    const std::filesystem::path shared = "/dev/shm";
    const auto base =
        std::filesystem::is_directory(shared) ? shared : std::filesystem::temp_directory_path();
    std::string name = (base / "gyrocal-fuzz-XXXXXX").string();
    GYROCAL_ASSERT(::mkdtemp(name.data()) != nullptr);
    path_ = name;
  }
  ~Folder() { std::filesystem::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  [[nodiscard]] const std::string& path() const { return path_; }

 private:
  std::string path_;
};

fuzz::Bytes read(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

void write(const std::string& path, const fuzz::Bytes& bytes) {
  std::ofstream(path, std::ios::binary)
      .write(reinterpret_cast<const char*>(bytes.data()),
             static_cast<std::streamsize>(bytes.size()));
}

bool same(double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); }

void check_read(const Session& session, const std::string& again_in) {
  GYROCAL_ASSERT(!session.samples.empty());
  for (std::size_t i = 1; i < session.monitor.size(); ++i) {
    GYROCAL_ASSERT(session.monitor[i].t_s > session.monitor[i - 1].t_s);
  }
  for (std::size_t i = 1; i < session.samples.size(); ++i) {
    const auto& a = session.samples[i - 1];
    const auto& b = session.samples[i];
    GYROCAL_ASSERT(a.dwell != b.dwell || (b.seq > a.seq && b.t_s >= a.t_s));
  }
  GYROCAL_ASSERT(write_session(again_in, session).has_value());
  const auto again = read_session(again_in);
  GYROCAL_ASSERT(again.has_value());
  GYROCAL_ASSERT(again->samples.size() == session.samples.size());
  for (std::size_t i = 0; i < session.samples.size(); ++i) {
    GYROCAL_ASSERT(same(again->samples[i].gyro_dps, session.samples[i].gyro_dps));
    GYROCAL_ASSERT(same(again->samples[i].t_s, session.samples[i].t_s));
  }
}

}  // namespace

int main(int argc, char** argv) {
  const Folder folder;
  const std::string sound = folder.path() + "/sound";
  const std::string spoilt = folder.path() + "/spoilt";
  GYROCAL_ASSERT(write_session(sound, small_session()).has_value());
  GYROCAL_ASSERT(write_session(spoilt, small_session()).has_value());
  std::vector<fuzz::Bytes> files;
  for (const char* name : names) files.push_back(read(sound + "/" + name));
  std::size_t last = 0;
  return fuzz::run(argc, argv, files, [&](const fuzz::Bytes& bytes, std::mt19937_64& random) {
    const auto which = random() % files.size();
    write(spoilt + "/" + names[last], files[last]);
    write(spoilt + "/" + names[which], bytes);
    last = which;
    const auto session = read_session(spoilt);
    if (session) return check_read(*session, folder.path() + "/again");
    GYROCAL_ASSERT(session.error().what.find(spoilt) != std::string::npos);
  });
}
