#include "drivers/recording/recording_file.h"

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <csignal>
#include <fstream>

#include "tests/drivers/recording/random_events.h"
#include "tests/drivers/recording/temporary_directory.h"

using namespace gyrocal;
using gyrocal::test::TemporaryDirectory;

namespace {

RecordedRun a_run() {
  return {1, 1'767'225'600'000'000'000, "0.1.0", "[campaign]\n", "{}", {"chamber", "board left"}};
}

/// Events a tenth of a second apart.
std::vector<RecordedEvent> timed_events(std::size_t count, unsigned seed = 1) {
  std::mt19937 random(seed);
  auto events = test::random_events(count, random);
  Instant t{};
  for (auto& event : events) {
    event.begin = t;
    event.end = t += seconds(0.1);
  }
  return events;
}

std::vector<RecordedEvent> read_all(const std::string& path, std::int64_t run = 1) {
  auto reader = RecordingReader::open(path, run);
  REQUIRE(reader);
  std::vector<RecordedEvent> events;
  for (;;) {
    auto event = reader->next();
    REQUIRE(event);
    if (!*event) return events;
    events.push_back(std::move(**event));
  }
}

}  // namespace

TEST_CASE("what is recorded is read back in order", "[recording]") {
  const TemporaryDirectory directory;
  const std::string path = directory.file("a.recording.db");
  const auto events = timed_events(30000);
  {
    const auto writer = RecordingWriter::open(path, a_run(), seconds(60));
    REQUIRE(writer);
    for (const auto& event : events) (*writer)->append(event);
    CHECK_FALSE((*writer)->trouble());
  }
  CHECK(read_all(path) == events);
  CHECK(*recorded_runs(path) == std::vector<RecordedRun>{a_run()});
}

TEST_CASE("a crash between two merges of small pieces loses nothing of either", "[recording]") {
  const TemporaryDirectory directory;
  const std::string path = directory.file("a.recording.db");
  const auto events = timed_events(12345);
  const pid_t child = fork();
  REQUIRE(child >= 0);
  if (child == 0) {
    const auto writer = RecordingWriter::open(path, a_run(), seconds(60));
    for (const auto& event : events) (*writer)->append(event);
    (*writer)->flush();
    raise(SIGKILL);
  }
  int status = 0;
  REQUIRE(waitpid(child, &status, 0) == child);
  CHECK(read_all(path) == events);
}

TEST_CASE("a resumed campaign adds a run to its recording", "[recording]") {
  const TemporaryDirectory directory;
  const std::string path = directory.file("a.recording.db");
  const auto first = timed_events(50, 1);
  const auto second = timed_events(70, 2);
  for (const auto& events : {first, second}) {
    const auto writer = RecordingWriter::open(path, a_run(), seconds(1));
    REQUIRE(writer);
    for (const auto& event : events) (*writer)->append(event);
  }
  CHECK(read_all(path, 1) == first);
  CHECK(read_all(path, 2) == second);
  CHECK(recorded_runs(path)->size() == 2);
}

TEST_CASE("a process killed in the middle loses at most the last second", "[recording]") {
  const TemporaryDirectory directory;
  const std::string path = directory.file("a.recording.db");
  const std::size_t count = GENERATE(5u, 500u);
  const auto events = timed_events(count);
  const pid_t child = fork();
  REQUIRE(child >= 0);
  if (child == 0) {
    const auto writer = RecordingWriter::open(path, a_run(), seconds(1));
    for (const auto& event : events) (*writer)->append(event);
    raise(SIGKILL);
  }
  int status = 0;
  REQUIRE(waitpid(child, &status, 0) == child);
  REQUIRE(WIFSIGNALED(status));
  const auto read = read_all(path);
  CHECK(read.size() + 10 >= count);
  CHECK(std::equal(read.begin(), read.end(), events.begin()));
}

TEST_CASE("a file that is no recording is refused and left as it is", "[recording]") {
  const TemporaryDirectory directory;
  const std::string path = directory.file("notes.txt");
  std::ofstream(path) << "not a database, but long enough to look like something at least\n";
  CHECK(RecordingWriter::open(path, a_run(), seconds(1)).error().code == Errc::storage);
  CHECK(RecordingReader::open(path, 1).error().code == Errc::storage);
  CHECK(std::filesystem::file_size(path) == 64);
  CHECK(RecordingReader::open(directory.file("absent"), 1).error().code == Errc::storage);
  CHECK_FALSE(std::filesystem::exists(directory.file("absent")));
}

TEST_CASE("a full disk ends the recording, not the program, and says why", "[recording]") {
  const TemporaryDirectory directory;
  const std::string path = directory.file("a.recording.db");
  const pid_t child = fork();
  REQUIRE(child >= 0);
  if (child == 0) {
    std::signal(SIGXFSZ, SIG_IGN);
    const auto writer = RecordingWriter::open(path, a_run(), seconds(60));
    const rlimit limit{200'000, 200'000};
    setrlimit(RLIMIT_FSIZE, &limit);
    for (const auto& event : timed_events(30000)) (*writer)->append(event);
    const bool said = (*writer)->trouble() && (*writer)->trouble()->code == Errc::storage;
    _exit(said ? 0 : 1);
  }
  int status = 0;
  REQUIRE(waitpid(child, &status, 0) == child);
  CHECK(WIFEXITED(status));
  CHECK(WEXITSTATUS(status) == 0);
  const auto events = timed_events(30000);
  const auto read = read_all(path);
  CHECK_FALSE(read.empty());
  CHECK(std::equal(read.begin(), read.end(), events.begin()));
}
