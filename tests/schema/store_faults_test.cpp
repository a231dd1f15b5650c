// Every call of the file layer fails in its turn, first once, then for good; the power goes at any
// group. A group is stored whole or not at all, and what was acknowledged stays.
#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <optional>

#include "schema/sqlite.h"
#include "tests/schema/faulty_vfs.h"
#include "tests/schema/small_campaign.h"
#include "tests/schema/temporary_folder.h"

using namespace gyrocal;

namespace {

/// Rows of a database that no faults touch any more; -1 for one that is not sound.
struct Counts {
  std::int64_t dwells = -1;
  std::int64_t samples = -1;
  bool operator==(const Counts&) const = default;
};

Counts counts(const std::string& path) {
  const auto database = Database::open(path, OpenMode::read_only).value();
  auto check = database.prepare("PRAGMA integrity_check").value();
  REQUIRE(check.next().value());
  CHECK(check.text(0) == "ok");
  return {database.integer("SELECT count(*) FROM dwell").value(),
          database.integer("SELECT count(*) FROM sample").value()};
}

}  // namespace

TEST_CASE("whichever file call fails, a group is stored whole or not at all", "[store][fault]") {
  const auto kind = GENERATE(FaultyVfs::Kind::io_error, FaultyVfs::Kind::disk_full);
  const bool for_good = GENERATE(false, true);
  CAPTURE(static_cast<int>(kind), for_good);
  int n = 0;
  int failed = 0;
  for (;; ++n) {
    CAPTURE(n);
    const TemporaryFolder folder;
    const auto path = folder / "a.db";
    FaultyVfs faulty;
    std::optional<Store> store = Store::open(path).value();
    const auto ids = small_campaign::begin(*store);
    REQUIRE(small_campaign::log_group(*store, ids, 0, 200).has_value());

    faulty.fail_call(n, kind, for_good);
    const auto stored = small_campaign::log_group(*store, ids, 1, 200);
    const bool fired = faulty.fired();
    faulty.fail_nothing();
    if (!stored) {
      ++failed;
      CHECK(stored.error().code == Errc::storage);
      CHECK_THAT(stored.error().what, Catch::StartsWith("store the dwells of setpoint 1: " + path));
    }
    CHECK(counts(path) == (stored ? Counts{4, 800} : Counts{2, 400}));
    CHECK(small_campaign::log_group(*store, ids, 2, 200).has_value());  // the store goes on
    store.reset();
    CHECK(counts(path) == (stored ? Counts{6, 1200} : Counts{4, 800}));
    if (!fired) break;
  }
  CHECK(n > 5);
  CHECK(failed > 3);
}

TEST_CASE("whichever file call fails while opening, the database is not harmed", "[store][fault]") {
  const TemporaryFolder folder;
  const auto path = folder / "a.db";
  {
    auto store = Store::open(path).value();
    const auto ids = small_campaign::begin(store);
    REQUIRE(small_campaign::log_group(store, ids, 0).has_value());
  }
  const auto before = dump(path);
  int n = 0;
  for (;; ++n) {
    CAPTURE(n);
    FaultyVfs faulty;
    faulty.fail_call(n, FaultyVfs::Kind::io_error, true);
    { const auto store = Store::open(path); }
    const bool fired = faulty.fired();
    faulty.fail_nothing();
    CHECK(dump(path) == before);
    if (!fired) break;
  }
  CHECK(n > 5);
}

TEST_CASE("whichever file call fails while creating, the next start creates it", "[store][fault]") {
  int n = 0;
  for (;; ++n) {
    CAPTURE(n);
    const TemporaryFolder folder;
    FaultyVfs faulty;
    faulty.fail_call(n, FaultyVfs::Kind::io_error, true);
    { const auto store = Store::open(folder / "a.db"); }
    const bool fired = faulty.fired();
    faulty.fail_nothing();
    auto store = Store::open(folder / "a.db");
    if (!store) FAIL(store.error().what);
    CHECK(small_campaign::log_group(*store, small_campaign::begin(*store), 0).has_value());
    if (!fired) break;
  }
  CHECK(n > 10);
}

TEST_CASE("after a power cut every acknowledged group is there", "[store][fault]") {
  const int groups = GENERATE(0, 1, 2, 3);
  const TemporaryFolder folder;
  const auto path = folder / "a.db";
  FaultyVfs faulty;
  auto store = std::make_unique<Store>(Store::open(path).value());
  const auto ids = small_campaign::begin(*store);
  for (int i = 0; i < groups; ++i) {
    REQUIRE(small_campaign::log_group(*store, ids, i, 300).has_value());
  }
  faulty.power_cut(path);
  std::filesystem::copy(path, folder / "after.db");
  if (std::filesystem::exists(path + "-wal")) {
    std::filesystem::copy(path + "-wal", folder / "after.db-wal");
  }
  CHECK(counts(folder / "after.db") == Counts{2 * groups, 600 * groups});
}

TEST_CASE("the power cut of these tests does lose what nobody synced", "[store][fault]") {
  const TemporaryFolder folder;
  const auto path = folder / "a.db";
  FaultyVfs faulty;
  const auto database = Database::open(path, OpenMode::read_write_create).value();
  REQUIRE(
      database.execute("PRAGMA journal_mode = WAL; PRAGMA synchronous = FULL; "
                       "CREATE TABLE t(a); PRAGMA synchronous = OFF; INSERT INTO t VALUES (1)"));
  faulty.power_cut(path);
  std::filesystem::copy(path, folder / "after.db");
  std::filesystem::copy(path + "-wal", folder / "after.db-wal");
  const auto after = Database::open(folder / "after.db", OpenMode::read_only).value();
  CHECK(after.integer("SELECT count(*) FROM t").value() == 0);
}

TEST_CASE("a process killed between groups leaves the groups it stored", "[store][fault]") {
  const int groups = GENERATE(1, 2, 3);
  const TemporaryFolder folder;
  const auto path = folder / "a.db";
  const pid_t child = ::fork();
  if (child == 0) {
    auto store = Store::open(path).value();
    const auto ids = small_campaign::begin(store);
    for (int i = 0; i < groups; ++i) (void)small_campaign::log_group(store, ids, i);
    ::_exit(0);  // as kill -9 would: nothing closed, nothing flushed
  }
  ::waitpid(child, nullptr, 0);
  auto store = Store::open(path).value();
  const auto open = store.open_campaign().value();
  REQUIRE(open.has_value());
  CHECK(open->dwells.size() == static_cast<std::size_t>(2 * groups));
}
