#include "tests/faults/invariants.h"

#include <fmt/core.h>

#include <cmath>

#include "schema/sqlite.h"

namespace gyrocal::faults {
namespace {

constexpr Duration silence_max = std::chrono::hours{25};  // a pause may last a day
constexpr Kelvin between_polls{0.5};                      // the air goes on between two readings

std::string board_in(const std::string& text) {
  const auto begin = text.find(' ') + 1;
  return text.substr(begin, text.find_first_of(": ", begin) - begin);
}

struct Promise {
  const char* promise;
  const char* violations;  ///< a query that counts them
};

constexpr Promise promises[] = {
    {"every row points to one that is there", "SELECT count(*) FROM pragma_foreign_key_check"},
    {"a setpoint has one accepted dwell a board",
     "SELECT count(*) FROM (SELECT 1 FROM dwell WHERE reject_reason IS NULL "
     "GROUP BY board_id, ordinal HAVING count(*) > 1)"},
    {"an accepted dwell has all its samples",
     "SELECT count(*) FROM dwell d WHERE reject_reason IS NULL AND (SELECT samples_per_setpoint "
     "FROM campaign) <> (SELECT count(*) FROM sample WHERE dwell_id = d.id)"},
    {"a dwell has the samples it says",
     "SELECT count(*) FROM dwell d WHERE samples <> (SELECT count(*) FROM sample WHERE dwell_id = "
     "d.id)"},
    {"each sample has one board and one setpoint",
     "SELECT count(*) FROM sample s LEFT JOIN dwell d ON d.id = s.dwell_id LEFT JOIN setpoint p "
     "USING (campaign_id, ordinal) LEFT JOIN board b ON b.id = d.board_id "
     "WHERE p.setpoint_c IS NULL OR b.name IS NULL"},
    {"a dwell's samples were taken in it",
     "SELECT count(*) FROM sample s JOIN dwell d ON d.id = s.dwell_id "
     "WHERE s.t_ns NOT BETWEEN d.t_start_ns AND d.t_end_ns"},
    {"samples come in order of time",
     "SELECT count(*) FROM sample a JOIN sample b ON b.dwell_id = a.dwell_id AND b.seq = a.seq + 1 "
     "WHERE b.t_ns <= a.t_ns"},
    {"a board is in one dwell at a time",
     "SELECT count(*) FROM dwell a JOIN dwell b ON a.board_id = b.board_id AND a.id < b.id "
     "WHERE b.t_start_ns < a.t_end_ns"},
    {"no accepted dwell is logged again",
     "SELECT count(*) FROM dwell a JOIN dwell b ON a.board_id = b.board_id AND a.ordinal = "
     "b.ordinal AND a.id < b.id WHERE a.reject_reason IS NULL"},
    {"an accepted dwell lost no more frames than allowed",
     "SELECT count(*) FROM dwell WHERE reject_reason IS NULL "
     "AND frames_missing > 0.01 * (samples + frames_missing)"},
    {"an accepted dwell has its temperature",
     "SELECT count(*) FROM dwell WHERE reject_reason IS NULL AND chamber_mean_c IS NULL"},
    {"campaign time does not run backwards",
     "SELECT count(*) FROM event a JOIN event b ON b.id = a.id + 1 WHERE b.t_ns < a.t_ns"},
    {"a missing dwell is accounted for",
     "SELECT (SELECT count(*) FROM setpoint) * (SELECT count(*) FROM board) > (SELECT count(*) "
     "FROM "
     "dwell WHERE reject_reason IS NULL) AND (SELECT state FROM campaign) = 'finished' AND NOT "
     "EXISTS (SELECT 1 FROM event WHERE kind IN ('setpoint_failed', 'board_given_up')) AND NOT "
     "EXISTS "
     "(SELECT 1 FROM dwell WHERE reject_reason LIKE 'skipped%')"},
};

std::string text_of(const Database& database, const std::string& sql) {
  auto statement = database.prepare(sql);
  if (!statement || !statement->next().value_or(false)) throw Broken{"cannot ask " + sql};
  return statement->text(0);
}

struct Dwell {
  Duration from;
  Duration to;
  Celsius setpoint;
};

std::vector<Dwell> accepted_in(const Database& database) {
  std::vector<Dwell> dwells;
  auto rows = database.prepare(
      "SELECT t_start_ns, t_end_ns, setpoint_c FROM dwell JOIN setpoint USING (campaign_id, "
      "ordinal) WHERE reject_reason IS NULL");
  while (rows && rows->next().value_or(false)) {
    dwells.push_back(
        {Duration{rows->integer(0)}, Duration{rows->integer(1)}, Celsius{rows->real(2)}});
  }
  return dwells;
}

}  // namespace

void JournalCheck::process_began(Instant world_now) {
  last_ = world_now;
  chamber_lost_ = false;
  boards_lost_.clear();
}

void JournalCheck::told(const EventInsert& event, Instant world_now) {
  checks_.require(world_now - last_ < silence_max, "progress or an alarm", event.text);
  last_ = world_now;
  if (event.kind == "chamber_lost" || event.kind == "chamber_back") {
    const bool lost = event.kind == "chamber_lost";
    checks_.require(lost != chamber_lost_, "one event an outage, one at its end", event.text);
    chamber_lost_ = lost;
  }
  if (event.kind == "board_lost") {
    checks_.require(boards_lost_.insert(board_in(event.text)).second, "one event an outage",
                    event.text);
  }
  if (event.kind == "board_back") {
    checks_.require(boards_lost_.erase(board_in(event.text)) == 1, "one event at its end",
                    event.text);
  }
}

void AcknowledgedCheck::look(const Store& store) {
  const auto campaign = store.latest_campaign();
  if (!campaign) throw Broken{to_text(campaign.error())};
  if (!*campaign) return checks_.require(seen_.empty(), "nothing acknowledged vanishes");
  const auto boards = store.boards(**campaign);
  if (!boards) throw Broken{to_text(boards.error())};
  std::map<std::pair<BoardId, int>, DwellId> now;
  for (const auto& [id, row] : *boards) {
    const auto dwells = store.accepted_dwells(**campaign, id);
    if (!dwells) throw Broken{to_text(dwells.error())};
    for (const AcceptedDwell& dwell : *dwells) now.emplace(std::pair{id, dwell.ordinal}, dwell.id);
  }
  for (const auto& [where, dwell] : seen_) {
    const auto found = now.find(where);
    checks_.require(found != now.end() && found->second == dwell, "nothing acknowledged vanishes",
                    fmt::format("setpoint {}", where.second));
  }
  seen_ = std::move(now);
}

void check_database(const std::string& path, const std::string& state, Kelvin dwell_band,
                    const std::vector<TrueAir>& while_logging, Checks& checks) {
  const auto database = Database::open(path, OpenMode::read_only);
  if (!database) throw Broken{to_text(database.error())};
  checks.require(text_of(*database, "PRAGMA integrity_check") == "ok", "the database is sound");
  const std::string stored = text_of(*database, "SELECT state FROM campaign");
  checks.require(stored == state, "the campaign's row says how it ended", stored + ", " + state);
  for (const Promise& promise : promises) {
    const auto violations = database->integer(promise.violations);
    if (!violations) throw Broken{to_text(violations.error())};
    checks.require(*violations == 0, promise.promise, fmt::format("{} are not", *violations));
  }
  for (const Dwell& dwell : accepted_in(*database)) {
    for (const TrueAir& then : while_logging) {
      if (then.t < dwell.from || then.t > dwell.to) continue;
      const double off_k = std::abs((then.air - dwell.setpoint).value);
      checks.require(off_k <= dwell_band.value + between_polls.value,
                     "the air of an accepted dwell was in its band",
                     fmt::format("{:.2f} degC at {:.1f}", then.air.value, dwell.setpoint.value));
    }
  }
}

}  // namespace gyrocal::faults
