// Databases that cannot be used: each says which file, what is wrong with it, and stays as it was.
#include <fmt/core.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "schema/migrate.h"
#include "schema/sqlite.h"
#include "tests/schema/small_campaign.h"
#include "tests/schema/temporary_folder.h"

using namespace gyrocal;

namespace {

std::string bytes_of(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

void write_database(const std::string& path, const std::string& sql) {
  REQUIRE(Database::open(path, OpenMode::read_write_create).value().execute(sql).has_value());
}

/// Runs `body` in a child of its own without root's power over permissions; it says what it saw.
template <class Body>
std::string without_privilege(const Body& body) {
  int ends[2];
  REQUIRE(::pipe(ends) == 0);
  const pid_t child = ::fork();
  if (child == 0) {
    if (::geteuid() == 0 && ::setuid(65534) != 0) ::_exit(1);
    const std::string saw = body();
    ::_exit(::write(ends[1], saw.data(), saw.size()) < 0 ? 1 : 0);
  }
  ::close(ends[1]);
  std::string saw(4096, '\0');
  const auto got = ::read(ends[0], saw.data(), saw.size());
  ::close(ends[0]);
  ::waitpid(child, nullptr, 0);
  saw.resize(got > 0 ? static_cast<std::size_t>(got) : 0);
  return saw;
}

std::string open_says(const std::string& path) {
  const auto store = Store::open(path);
  return store ? "opened" : to_text(store.error());
}

std::string open_read_only_says(const std::string& path) {
  const auto store = Store::open_read_only(path);
  if (!store) return to_text(store.error());
  const auto id = store->latest_campaign();
  if (!id) return to_text(id.error());
  return "campaign " + std::to_string(static_cast<std::int64_t>(id->value()));
}

}  // namespace

TEST_CASE("a file that is no database is refused and stays as it was", "[store][bad]") {
  const TemporaryFolder folder;
  const auto path = folder / "notes.txt";
  write_file(path, std::string(5000, 'x'));
  for (const auto& says : {open_says(path), open_read_only_says(path)}) {
    CHECK(says == path +
                      ": file is not a database; give the name of a gyrocal database, or of a "
                      "new file");
  }
  CHECK(bytes_of(path) == std::string(5000, 'x'));
  CHECK_FALSE(std::filesystem::exists(path + "-writer"));
}

TEST_CASE("a database of another application is refused and stays as it was", "[store][bad]") {
  const TemporaryFolder folder;
  const auto path = folder / "other.db";
  SECTION("with an id of its own") {
    write_database(path, "PRAGMA application_id = 1; CREATE TABLE t(a)");
  }
  SECTION("without one") { write_database(path, "CREATE TABLE t(a)"); }
  const auto before = bytes_of(path);
  CHECK_THAT(open_says(path), Catch::Contains(path + ": a database of another application"));
  CHECK_THAT(open_read_only_says(path), Catch::Contains("a database of another application"));
  CHECK(bytes_of(path) == before);
}

TEST_CASE("a database of a newer schema is refused and stays as it was", "[store][bad]") {
  const TemporaryFolder folder;
  const auto path = folder / "newer.db";
  { auto store = Store::open(path).value(); }
  write_database(path, "PRAGMA user_version = 99; PRAGMA journal_mode = DELETE");
  const auto before = bytes_of(path);
  const auto expected = fmt::format(
      "{}: schema 99, written by a newer gyrocal; this one knows up to {}; install the newer "
      "gyrocal",
      path, newest_version(embedded_migrations()));
  CHECK(open_says(path) == expected);
  CHECK(open_read_only_says(path) == expected);
  CHECK(bytes_of(path) == before);
}

TEST_CASE("a second writer is told who holds the database; readers are not disturbed",
          "[store][bad]") {
  const TemporaryFolder folder;
  const auto path = folder / "a.db";
  auto store = Store::open(path).value();
  const auto ids = small_campaign::begin(store);
  const auto second = Store::open(path);
  REQUIRE_FALSE(second.has_value());
  CHECK(second.error().code == Errc::busy);
  CHECK(second.error().what ==
        path + ": process " + std::to_string(::getpid()) + " is writing to it");
  CHECK(without_privilege([&] { return open_says(path); }) != "opened");
  CHECK(open_read_only_says(path) == "campaign 1");
  CHECK(small_campaign::log_group(store, ids, 0).has_value());  // the first goes on
}

TEST_CASE("a writer that is gone, however it ended, locks nobody out", "[store]") {
  const TemporaryFolder folder;
  const auto path = folder / "a.db";
  const pid_t child = ::fork();
  if (child == 0) {
    auto store = Store::open(path);
    if (store) small_campaign::begin(*store);
    ::_exit(0);  // neither closed nor unlocked
  }
  ::waitpid(child, nullptr, 0);
  CHECK(std::filesystem::exists(path + "-writer"));
  auto store = Store::open(path).value();
  CHECK(store.latest_campaign().value() == CampaignId{1});
}

TEST_CASE("a closed store leaves one file", "[store]") {
  const TemporaryFolder folder;
  {
    auto store = Store::open(folder / "a.db").value();
    small_campaign::begin(store);
  }
  int files = 0;
  for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(folder.path())) {
    ++files;
  }
  CHECK(files == 1);
}

TEST_CASE("who may not write is told so at once, and may read", "[store][bad]") {
  const TemporaryFolder folder;
  const auto path = folder / "a.db";
  {
    auto store = Store::open(path).value();
    small_campaign::begin(store);
  }
  const auto before = bytes_of(path);
  ::chmod(path.c_str(), 0444);
  SECTION("a folder nobody may write to") {
    ::chmod(folder.path().c_str(), 0555);
    CHECK_THAT(without_privilege([&] { return open_says(path); }),
               Catch::Contains(path + "-writer: Permission denied"));
    CHECK(without_privilege([&] { return open_read_only_says(path); }) == "campaign 1");
  }
  SECTION("a file nobody may write to") {
    ::chmod(folder.path().c_str(), 0777);
    CHECK_THAT(without_privilege([&] { return open_says(path); }),
               Catch::Contains("open " + path +
                               " to write: Permission denied; check the permissions "
                               "of the file and its folder"));
  }
  SECTION("a name with the characters of a URI") {
    std::filesystem::rename(path, folder / "50% a?b#c.db");
    ::chmod(folder.path().c_str(), 0555);
    CHECK(without_privilege([&] { return open_read_only_says(folder / "50% a?b#c.db"); }) ==
          "campaign 1");
    ::chmod(folder.path().c_str(), 0777);
    std::filesystem::rename(folder / "50% a?b#c.db", path);
  }
  ::chmod(folder.path().c_str(), 0777);
  CHECK(bytes_of(path) == before);
}

TEST_CASE("a path that leads nowhere is named", "[store][bad]") {
  CHECK_THAT(open_says("/nowhere/a.db"),
             Catch::StartsWith("lock /nowhere/a.db-writer: No such file or directory"));
  CHECK_THAT(open_read_only_says("/nowhere/a.db"),
             Catch::StartsWith("open /nowhere/a.db: No such file or directory"));
}

TEST_CASE("an empty database is nothing to read from", "[store][bad]") {
  const TemporaryFolder folder;
  write_file(folder / "empty.db", "");
  CHECK_THAT(open_read_only_says(folder / "empty.db"), Catch::Contains("holds nothing"));
  CHECK(open_says(folder / "empty.db") == "opened");
}
