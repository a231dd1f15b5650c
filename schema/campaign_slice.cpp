#include "schema/campaign_slice.h"

#include <fmt/core.h>

#include "schema/backup.h"
#include "schema/open_database.h"
#include "schema/store_impl.h"

namespace gyrocal {
namespace {

/// ?1: the campaign, ?2: the latest time kept. Foreign keys are off: the order is for the reader.
constexpr const char* leave_out[] = {
    "DELETE FROM finding",
    "DELETE FROM diagnosis",
    "DELETE FROM rig_effect",
    "DELETE FROM rig_model",
    "DELETE FROM analysis WHERE campaign_id <> ?1 OR ?2 < 9223372036854775807",
    "DELETE FROM dwell_drift WHERE analysis_id NOT IN (SELECT id FROM analysis)",
    "DELETE FROM model WHERE analysis_id NOT IN (SELECT id FROM analysis)",
    "DELETE FROM model_dwell WHERE model_id NOT IN (SELECT id FROM model)",
    "DELETE FROM model_point WHERE model_id NOT IN (SELECT id FROM model)",
    "DELETE FROM dwell WHERE campaign_id <> ?1 OR t_end_ns > ?2",
    "DELETE FROM sample WHERE dwell_id NOT IN (SELECT id FROM dwell)",
    "DELETE FROM board WHERE campaign_id <> ?1",
    "DELETE FROM monitor WHERE t_ns > ?2 OR board_id NOT IN (SELECT id FROM board)",
    "DELETE FROM event WHERE campaign_id <> ?1 OR t_ns > ?2",
    "DELETE FROM setpoint WHERE campaign_id <> ?1",
    "DELETE FROM campaign WHERE id <> ?1",
};

/// Binds only what the statement has.
Result<void> run_for(const Database& database, const std::string& sql, const CampaignSlice& slice) {
  auto statement = database.prepare(sql);
  if (!statement) return tl::unexpected(statement.error());
  if (sql.find("?1") != std::string::npos) statement->bind(0, key(slice.campaign));
  if (sql.find("?2") != std::string::npos) statement->bind(1, slice.t_last_ns);
  return statement->run_bound();
}

Result<void> keep_slice(const Database& copy, const CampaignSlice& slice) {
  for (const char* sql : leave_out) {
    // A statement with ?2 alone still counts it as its second parameter.
    if (auto done = run_for(copy, sql, slice); !done) return done;
  }
  return run(copy,
             "UPDATE campaign SET state = coalesce(?, state), config_toml = coalesce(?, "
             "config_toml)",
             slice.state, slice.config_toml);
}

Result<void> expect_campaign(const Database& database, CampaignId campaign) {
  auto count =
      database.integer(fmt::format("SELECT count(*) FROM campaign WHERE id = {}", key(campaign)));
  if (!count) return tl::unexpected(count.error());
  if (*count == 1) return {};
  return fail(Errc::unknown_name, fmt::format("{}: no campaign {}", database.path(), key(campaign)),
              "`gyrocal db summary` lists its campaigns");
}

}  // namespace

Result<void> cut_out_campaign(const std::string& source, const std::string& target,
                              const CampaignSlice& slice) {
  const auto database = open_to_read(source);
  if (!database) return tl::unexpected(database.error());
  if (auto known = expect_campaign(*database, slice.campaign); !known) return known;
  if (auto copied = backup(*database, target); !copied) return copied;
  const auto copy = Database::open(target, OpenMode::read_write_create);
  if (!copy) return tl::unexpected(copy.error());
  if (auto kept = copy->transaction([&] { return keep_slice(*copy, slice); }); !kept) return kept;
  return copy->execute("VACUUM");
}

}  // namespace gyrocal
