// Every call of every seam of the daemon fails in its turn, first once, then for good, under a
// whole small campaign; and the power goes at every turn of its loop.
#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <optional>

#include "daemon/runner/campaign_runner.h"
#include "daemon/runner/run_request.h"
#include "drivers/board/inemo_board.h"
#include "drivers/chamber/modbus_chamber.h"
#include "drivers/clocks.h"
#include "drivers/recording/faulty_link.h"
#include "drivers/simulated/in_process_links.h"
#include "drivers/simulated/simulated_rig.h"
#include "schema/sqlite.h"
#include "tests/daemon/runner/temporary_folder.h"
#include "tests/schema/faulty_vfs.h"

namespace gyrocal::runner {
namespace {

/// Two setpoints near the air's temperature, two boards, dwells of twenty samples.
const std::string tiny_campaign = R"([campaign]
name = "tiny"
simulated = true
[plan]
setpoints_c = [22, 24]
samples_per_setpoint = 20
sample_rate_hz = 10
ramp_k_per_min = 2
safe_setpoint_c = 23
[chamber]
profile = "yinhe"
host = "127.0.0.1"
[[board]]
name = "left"
device = "/dev/left"
[[board]]
name = "right"
device = "/dev/right"
[stability]
air_window_s = 20
air_peak_to_peak_k = 1
board_window_s = 30
soak_s_min = 20
[limits]
board_away_s_max = 60
[analysis]
level = 1
)";

constexpr Fault never{std::numeric_limits<std::size_t>::max()};
constexpr std::size_t all_dwells = 4;
constexpr int turns_max = 500;  // a campaign has seventy

struct PowerCut {};

CampaignConfig parsed() {
  // What fails here is not the disk: a commit need not wait for one.
  if (std::filesystem::is_directory("/dev/shm")) ::setenv("TMPDIR", "/dev/shm", 0);
  auto config = parse_campaign(tiny_campaign,
                               std::string(GYROCAL_SOURCE_DIR) + "/config/campaigns/tiny.toml");
  if (!config) FAIL(to_text(config.error()));
  return *config;
}

/// The rig, and one process after the other that runs the campaign on it.
class Bench {
 public:
  explicit Bench(const std::string& database)
      : database_(database), rig_({}, 1, 2, config_.chamber.profile, config_.chamber.unit) {}

  /// One process, with a fault in the chamber's link and one in the left board's.
  Result<Outcome> run(const Fault& chamber_fault = never, const Fault& board_fault = never) {
    auto store = Store::open(database_);
    if (!store) return tl::unexpected(store.error());
    InProcessChamberLink chamber_wire(rig_.chamber(), clock_, seconds(1));
    FaultyRequestLink chamber_link(chamber_wire, chamber_fault);
    ModbusChamber chamber(chamber_link, clock_, config_.chamber.profile, config_.chamber.unit);
    InProcessBoardLink left_wire(rig_.board(0), clock_);
    FaultyByteLink left_link(left_wire, board_fault);
    InemoBoard left(left_link, clock_);
    InProcessBoardLink right_link(rig_.board(1), clock_);
    InemoBoard right(right_link, clock_);
    RunOptions options = virtual_options(config_);
    options.software_version = "test";
    options.resume = true;
    RunHooks hooks;
    hooks.log = [&](const EventInsert& event) {
      begun = true;
      if (event.kind == "not_safe") not_safe = true;
    };
    int turns = 0;
    hooks.stop_asked = [&] { return ++turns > turns_max; };  // the safe state is tried for hours
    hooks.progress = [&](const Snapshot&) { turns_left-- == 0 ? at_turn() : void(); };
    const auto outcome =
        run_campaign(config_, {clock_, chamber, {&left, &right}}, *store, options, hooks);
    fired = chamber_link.fired() || left_link.fired();
    return outcome;
  }

  [[nodiscard]] SimulatedChamber& chamber() { return rig_.chamber(); }
  [[nodiscard]] Celsius safe() const { return config_.plan.safe_setpoint; }

  bool fired = false;     ///< the fault came about in the latest run
  bool begun = false;     ///< preflight has passed once
  bool not_safe = false;  ///< a person was told
  int turns_left = -1;
  std::function<void()> at_turn = [] {};

 private:
  std::string database_;
  CampaignConfig config_ = parsed();
  VirtualClock clock_;
  SimulatedRig rig_;
};

std::size_t accepted(const std::string& path) {
  const auto database = Database::open(path, OpenMode::read_only).value();
  auto sound = database.prepare("PRAGMA integrity_check").value();
  REQUIRE(sound.next().value());
  REQUIRE(sound.text(0) == "ok");
  REQUIRE(database
              .integer("SELECT count(*) FROM dwell d WHERE reject_reason IS NULL AND (SELECT "
                       "count(*) FROM sample WHERE dwell_id = d.id) <> 20")
              .value() == 0);
  return static_cast<std::size_t>(
      database.integer("SELECT count(*) FROM dwell WHERE reject_reason IS NULL").value());
}

/// Of the latest campaign; empty if there is none.
std::string state(const std::string& path) {
  const auto store = Store::open_read_only(path);
  const auto campaign = store ? *store->latest_campaign() : std::nullopt;
  return campaign ? store->campaign(*campaign)->state : "";
}

bool finished(const Result<Outcome>& outcome) {
  if (!outcome) UNSCOPED_INFO(to_text(outcome.error()));
  return outcome && std::holds_alternative<campaign::Finished>(outcome->state);
}

}  // namespace

TEST_CASE("whichever call of a link fails once, the campaign finishes with every dwell",
          "[fault]") {
  const bool of_chamber = GENERATE(true, false);
  const auto loses = GENERATE(Fault::Loses::request, Fault::Loses::reply);
  const auto code = GENERATE(Errc::timeout, Errc::link_lost);
  CAPTURE(of_chamber, static_cast<int>(loses), static_cast<int>(code));
  std::size_t n = 0;
  for (;; ++n) {
    CAPTURE(n);
    const TemporaryFolder folder;
    Bench bench(folder / "a.db");
    const Fault fault{n, code, Fault::Lasts::once, loses};
    auto outcome = of_chamber ? bench.run(fault) : bench.run(never, fault);
    if (!bench.fired) break;  // every call had its turn
    if (!outcome) {
      REQUIRE_FALSE(bench.begun);  // a start that fails is tried again, nothing else is
      outcome = bench.run();
    }
    REQUIRE(finished(outcome));
    REQUIRE(accepted(folder / "a.db") == all_dwells);
    REQUIRE(bench.chamber().setpoint() == bench.safe());
  }
  CHECK(n > 50);
}

TEST_CASE("from whichever call on the chamber's link fails for good: safe, or a person is told",
          "[fault]") {
  std::size_t n = 0;
  std::size_t tripped = 0;
  for (;; ++n) {
    CAPTURE(n);
    const TemporaryFolder folder;
    Bench bench(folder / "a.db");
    const auto outcome = bench.run({n, Errc::timeout, Fault::Lasts::for_good});
    if (!bench.fired) break;
    if (!outcome) {
      REQUIRE_FALSE(bench.begun);
      continue;
    }
    if (finished(outcome)) {  // the last polls of all
      REQUIRE(bench.chamber().setpoint() == bench.safe());
      continue;
    }
    ++tripped;
    REQUIRE(std::holds_alternative<campaign::Safe>(outcome->state));
    REQUIRE(bench.not_safe);
    const auto before = accepted(folder / "a.db");
    REQUIRE(finished(bench.run()));  // a person re-arms it
    REQUIRE(accepted(folder / "a.db") == all_dwells);
    REQUIRE(before <= all_dwells);
  }
  CHECK(tripped > 50);
}

TEST_CASE("from whichever call on a board's link fails for good: the other board has its dwells",
          "[fault]") {
  std::size_t n = 0;
  std::size_t without = 0;
  for (;; ++n) {
    CAPTURE(n);
    const TemporaryFolder folder;
    Bench bench(folder / "a.db");
    const auto outcome = bench.run(never, {n, Errc::link_lost, Fault::Lasts::for_good});
    if (!bench.fired) break;
    if (!outcome) {
      REQUIRE_FALSE(bench.begun);
      continue;
    }
    ++without;
    REQUIRE(finished(outcome));
    REQUIRE(accepted(folder / "a.db") >= all_dwells / 2);
  }
  CHECK(without > 20);
}

TEST_CASE("whichever file call fails under a campaign, the next start finishes it", "[fault]") {
  const auto kind = GENERATE(FaultyVfs::Kind::io_error, FaultyVfs::Kind::disk_full);
  const bool for_good = GENERATE(false, true);
  CAPTURE(static_cast<int>(kind), for_good);
  int failed = 0;
  for (int n = 0;; ++n) {
    CAPTURE(n);
    const TemporaryFolder folder;
    FaultyVfs faulty;
    Bench bench(folder / "a.db");
    faulty.fail_call(n, kind, for_good);
    const auto outcome = bench.run();
    const bool fired = faulty.fired();
    faulty.fail_nothing();
    if (!fired) break;
    if (!outcome) {
      ++failed;
      REQUIRE(outcome.error().code == Errc::storage);
      if (bench.begun) REQUIRE(bench.chamber().setpoint() == bench.safe());
      if (state(folder / "a.db") != "finished") REQUIRE(finished(bench.run()));
    }
    REQUIRE(accepted(folder / "a.db") == all_dwells);
  }
  CHECK(failed > 100);
}

TEST_CASE("the power goes at whichever turn: what was acknowledged is there, the rest is made up",
          "[fault]") {
  int turn = 0;
  for (;; ++turn) {
    CAPTURE(turn);
    const TemporaryFolder folder;
    const std::string before = folder / "before.db";
    const std::string after = folder / "after.db";
    std::size_t acknowledged = 0;
    FaultyVfs faulty;
    Bench bench(before);
    bench.turns_left = turn;
    bench.at_turn = [&] {
      acknowledged = accepted(before);
      faulty.power_cut(before);
      std::filesystem::copy(before, after);
      if (std::filesystem::exists(before + "-wal")) {
        std::filesystem::copy(before + "-wal", after + "-wal");
      }
      throw PowerCut{};
    };
    bool cut = false;
    try {
      static_cast<void>(bench.run());
    } catch (const PowerCut&) {
      cut = true;
    }
    if (!cut) break;  // no such turn: it ended before
    REQUIRE(accepted(after) == acknowledged);
    Bench next(after);
    if (state(after) != "finished") REQUIRE(finished(next.run()));
    REQUIRE(accepted(after) == all_dwells);
  }
  CHECK(turn > 20);
}

}  // namespace gyrocal::runner
