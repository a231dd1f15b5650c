#include <fmt/format.h>
#include <sqlite3.h>

#include <filesystem>
#include <memory>

#include "tests/bench/measure.h"
#include "tests/bench/python_peer.h"
#include "tests/bench/sample_campaign.h"
#include "tests/bench/scratch.h"
#include "tests/bench/sections.h"

namespace gyrocal::bench {
namespace {

constexpr int groups = 25;
constexpr int store_rounds = 9;
const CampaignShape one_board_shape{.boards = 1, .setpoints = groups};

struct TimesTaken {
  double cpu_s = 0;
  double wall_s = 0;
};

template <class Write>
TimesTaken time_writing(Write write) {
  const double wall = wall_now_s();
  const double cpu = cpu_now_s();
  write();
  return {cpu_now_s() - cpu, wall_now_s() - wall};
}

using Dwells = std::vector<std::vector<BoardSample>>;

Dwells make_dwells() {
  std::mt19937 random(11);
  Dwells dwells;
  for (int i = 0; i < groups; ++i)
    dwells.push_back(dwell_at(i, one_board_shape.dwell_samples, random));
  return dwells;
}

/// As the daemon does it, into a database of its own.
Result<TimesTaken> write_by_store(const std::string& path, const Dwells& dwells) {
  auto store = Store::open(path);
  if (!store) return tl::unexpected(store.error());
  std::vector<BoardId> boards;
  const auto campaign = begin_campaign(*store, one_board_shape, boards);
  if (!campaign) return tl::unexpected(campaign.error());
  Result<void> done;
  const TimesTaken taken = time_writing([&] {
    for (int i = 0; i < groups && done; ++i) {
      const auto& samples = dwells[static_cast<std::size_t>(i)];
      const DwellWithSamples dwell{dwell_row(boards.front(), i, samples), samples};
      const auto stored = store->add_group(*campaign, std::span(&dwell, 1));
      if (!stored) done = tl::unexpected(stored.error());
    }
  });
  return done ? Result<TimesTaken>(taken) : tl::unexpected(done.error());
}

struct CloseDatabase {
  void operator()(sqlite3* database) const { sqlite3_close(database); }
};
struct FinalizeStatement {
  void operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }
};
using DatabaseHandle = std::unique_ptr<sqlite3, CloseDatabase>;

bool execute(const DatabaseHandle& database, const std::string& sql) {
  return sqlite3_exec(database.get(), sql.c_str(), nullptr, nullptr, nullptr) == SQLITE_OK;
}

bool insert_samples(sqlite3_stmt* insert, std::int64_t dwell,
                    const std::vector<BoardSample>& samples) {
  std::int64_t seq = 0;
  for (const BoardSample& sample : samples) {
    sqlite3_bind_int64(insert, 1, dwell);
    sqlite3_bind_int64(insert, 2, seq++);
    sqlite3_bind_int64(insert, 3, sample.t_ns);
    for (int axis = 0; axis < 3; ++axis) {
      sqlite3_bind_int64(insert, 4 + axis, sample.gyro_lsb[static_cast<std::size_t>(axis)]);
    }
    sqlite3_bind_int64(insert, 7, *sample.temperature_raw);
    if (sqlite3_step(insert) != SQLITE_DONE || sqlite3_reset(insert) != SQLITE_OK) return false;
  }
  return true;
}

constexpr char insert_dwell[] =
    "INSERT INTO dwell (campaign_id, board_id, ordinal, attempt, t_start_ns, t_end_ns, timed_soak, "
    "samples, frames_missing, counter_first) VALUES (1, 1, {}, 1, 0, 1, 0, 3000, 0, 1)";

/// The same rows into the same tables in the same kind of transaction, by nothing but SQLite.
std::optional<TimesTaken> write_bare(const std::string& path, const Dwells& dwells) {
  sqlite3* opened = nullptr;
  const bool open = sqlite3_open(path.c_str(), &opened) == SQLITE_OK;
  const DatabaseHandle database(opened);
  sqlite3_stmt* prepared = nullptr;
  const bool ready =
      open &&
      execute(database,
              "PRAGMA journal_mode=WAL; PRAGMA synchronous=FULL; PRAGMA foreign_keys=ON") &&
      sqlite3_prepare_v2(database.get(), "INSERT INTO sample VALUES (?, ?, ?, ?, ?, ?, ?, ?)", -1,
                         &prepared, nullptr) == SQLITE_OK;
  const std::unique_ptr<sqlite3_stmt, FinalizeStatement> insert(prepared);
  if (!ready) return std::nullopt;
  bool done = true;
  const TimesTaken taken = time_writing([&] {
    for (int i = 0; i < groups && done; ++i) {
      done = execute(database, "BEGIN IMMEDIATE") &&
             execute(database, fmt::format(insert_dwell, i)) &&
             insert_samples(insert.get(), sqlite3_last_insert_rowid(database.get()),
                            dwells[static_cast<std::size_t>(i)]) &&
             execute(database, "COMMIT");
    }
  });
  return done ? std::optional(taken) : std::nullopt;
}

/// A database with the campaign's beginning and no sample, for the peers.
Result<void> begin_database(const std::string& path) {
  auto store = Store::open(path);
  if (!store) return tl::unexpected(store.error());
  std::vector<BoardId> boards;
  const auto campaign = begin_campaign(*store, one_board_shape, boards);
  return campaign ? Result<void>{} : tl::unexpected(campaign.error());
}

Spread per_sample(const std::vector<double>& seconds) {
  return spread_of(seconds) * (1.0 / static_cast<double>(one_board_shape.samples()));
}

}  // namespace

Rows store_rows() {
  const Scratch folder;
  const Dwells dwells = make_dwells();
  std::vector<double> ours_cpu, ours_wall, bare_cpu, bare_wall;
  for (int round = 0; round < store_rounds; ++round) {  // by turns: the disk is the same for both
    const auto ours = write_by_store(folder / fmt::format("ours{}.db", round), dwells);
    if (!ours) return {failed("store a sample", ours.error().what)};
    const std::string path = folder / fmt::format("bare{}.db", round);
    const auto begun = begin_database(path);
    const auto bare = begun ? write_bare(path, dwells) : std::nullopt;
    if (!bare) return {failed("store a sample", "the bare statement did not store it")};
    ours_cpu.push_back(ours->cpu_s);
    ours_wall.push_back(ours->wall_s);
    bare_cpu.push_back(bare->cpu_s);
    bare_wall.push_back(bare->wall_s);
  }
  const std::string path = folder / "python.db";
  const auto begun = begin_database(path);
  const auto python = begun ? ask_python("store_peer.py", {path}) : std::nullopt;
  Peer peer{"Python sqlite3", {}, "python3"};
  if (python) peer.took_s = spread_from(python->at("cpu_s"));
  const std::string job =
      fmt::format("store a sample, {} groups of {}", groups, one_board_shape.dwell_samples);
  const auto bytes = static_cast<double>(std::filesystem::file_size(folder / "ours0.db")) /
                     static_cast<double>(one_board_shape.samples());
  const Peer bare{"SQLite " SQLITE_VERSION, per_sample(bare_cpu), ""};
  const Peer bare_on_disk{"SQLite " SQLITE_VERSION, per_sample(bare_wall), ""};
  return {
      against(job, per_sample(ours_cpu), bare, 0.8, "a bare prepared INSERT of the same row"),
      against("the same, wall, each group synced", per_sample(ours_wall), bare_on_disk, 0.8, ""),
      against("the same, beside a script", per_sample(ours_cpu), peer, {}, "executemany"),
      number("a sample on disk", shown(bytes, "bytes"), "<= 40 bytes", bytes <= 40,
             "the whole file, tables and indices")};
}

}  // namespace gyrocal::bench
