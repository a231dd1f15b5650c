// gyrocald on real endpoints, killed at random instants, two hundred times: nothing accepted is
// lost, nothing is there twice, at most one group a kill is logged again.
#include <algorithm>
#include <catch2/catch.hpp>
#include <chrono>
#include <iostream>
#include <random>
#include <set>
#include <tuple>
#include <vector>

#include "schema/sqlite.h"
#include "tests/daemon/runner/daemon_process.h"
#include "tests/daemon/runner/served_rig.h"

namespace gyrocal::runner {
namespace {

constexpr int kills_wanted = 200;
constexpr std::chrono::seconds running_again_within{5};

using Clock = std::chrono::steady_clock;
using Accepted = std::set<std::tuple<std::int64_t, std::int64_t, std::int64_t>>;

struct Stored {
  Accepted accepted;    ///< board, setpoint, row
  std::int64_t groups;  ///< setpoints with an accepted dwell
  std::int64_t dwells_begun;
};

/// What a database holds, which must be sound. Nothing yet, if it was killed before its first row.
std::optional<Stored> stored_in(const std::string& path) {
  const auto database = Database::open(path, OpenMode::read_only);
  if (!database) return std::nullopt;
  if (database->integer("SELECT count(*) FROM sqlite_schema").value_or(0) == 0) return std::nullopt;
  auto sound = database->prepare("PRAGMA integrity_check");
  REQUIRE(sound);
  REQUIRE(sound->next().value());
  CHECK(sound->text(0) == "ok");
  CHECK(database
            ->integer("SELECT count(*) FROM dwell d WHERE reject_reason IS NULL AND "
                      "(SELECT count(*) FROM sample WHERE dwell_id = d.id) <> 200")
            .value() == 0);
  Stored stored{{},
                database->integer("SELECT count(DISTINCT ordinal) FROM dwell").value(),
                database
                    ->integer("SELECT count(*) FROM event WHERE text LIKE 'soaking -> "
                              "logging%'")
                    .value()};
  auto rows =
      database->prepare("SELECT board_id, ordinal, id FROM dwell WHERE reject_reason IS NULL");
  while (rows && rows->next().value_or(false)) {
    const bool first =
        std::none_of(stored.accepted.begin(), stored.accepted.end(), [&](const auto& other) {
          return std::get<0>(other) == rows->integer(0) && std::get<1>(other) == rows->integer(1);
        });
    CHECK(first);
    stored.accepted.emplace(rows->integer(0), rows->integer(1), rows->integer(2));
  }
  return stored;
}

/// One campaign, killed until it ends or `kills_left` is used up.
class KilledCampaign {
 public:
  KilledCampaign(const std::string& campaign, std::string database, const std::string& notify)
      : campaign_(campaign), database_(std::move(database)), notify_(notify), unit_(notify) {}

  int kill_until_it_ends(int kills_left, std::mt19937& random, std::vector<double>& starts_s) {
    int kills = 0;
    for (; kills < kills_left; ++kills) {
      Daemon daemon(campaign_, database_, notify_);
      const auto began = Clock::now();
      const auto lives = std::chrono::milliseconds{5 + random() % longest_life_ms_};
      unit_.forget();
      if (unit_.hears("READY=1", lives)) {
        const std::chrono::duration<double> took = Clock::now() - began;
        starts_s.push_back(took.count());
        too_short_ = 0;
        unit_.forget();
        const auto rest = began + lives - Clock::now();
        unit_.hears("STATUS=finished", std::chrono::ceil<std::chrono::milliseconds>(rest));
      }
      // Sanitized, on a busy machine, a start may take longer than any of these lives.
      if (++too_short_ == 10) longest_life_ms_ *= 2, too_short_ = 0;
      daemon.signal(SIGKILL);
      const bool was_killed = daemon.wait() == -1;
      look(kills + 1);
      if (!was_killed) break;
    }
    return kills;
  }

  /// Runs it to its end.
  void finish() {
    Daemon last(campaign_, database_, notify_);
    CHECK(last.wait() == 0);
    const auto stored = stored_in(database_);
    REQUIRE(stored);
    CHECK(std::includes(stored->accepted.begin(), stored->accepted.end(), before_.begin(),
                        before_.end()));
    CHECK(stored->accepted.size() == 6);
  }

 private:
  void look(int kills) {
    const auto stored = stored_in(database_);
    if (!stored) {
      CHECK(before_.empty());
      return;
    }
    CHECK(std::includes(stored->accepted.begin(), stored->accepted.end(), before_.begin(),
                        before_.end()));
    CHECK(stored->dwells_begun - stored->groups <= kills);
    before_ = stored->accepted;
  }

  std::string campaign_;
  std::string database_;
  std::string notify_;
  NotifySocket unit_;
  Accepted before_;
  unsigned longest_life_ms_ = 900;
  int too_short_ = 0;  ///< lives since the daemon was last ready
};

}  // namespace

SCENARIO("killed two hundred times, gyrocald goes on: no dwell lost, none twice") {
  const TemporaryFolder folder;
  const ServedRig rig(folder);
  const std::string campaign = folder.write("wired.toml", campaign_text(folder, rig.port()));
  const unsigned seed = std::random_device{}();
  CAPTURE(seed);
  std::mt19937 random(seed);
  std::vector<double> starts_s;
  int kills = 0;
  int campaigns = 0;
  while (kills < kills_wanted) {
    ++campaigns;
    KilledCampaign one(campaign, folder / fmt::format("{}.db", campaigns),
                       folder / fmt::format("notify{}", campaigns));
    kills += one.kill_until_it_ends(kills_wanted - kills, random, starts_s);
    one.finish();
  }
  REQUIRE_FALSE(starts_s.empty());
  std::sort(starts_s.begin(), starts_s.end());
  CHECK(starts_s.back() < std::chrono::duration<double>(running_again_within).count());
  std::cout << kills << " kills of " << campaigns << " campaigns (seed " << seed
            << "): nothing lost; running again in " << starts_s[starts_s.size() / 2]
            << " s (median), " << starts_s.back() << " s (longest)\n";
}

}  // namespace gyrocal::runner
