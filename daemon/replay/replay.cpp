#include "daemon/replay/replay.h"

#include <fmt/core.h>

#include <filesystem>
#include <future>

#include "daemon/replay/capsule_contents.h"
#include "daemon/replay/run_replay.h"
#include "daemon/replay/scratch_folder.h"
#include "schema/compare_campaigns.h"
#include "schema/maintenance.h"
#include "schema/open_database.h"

namespace gyrocal::replay {
namespace {

constexpr char recording_ending[] = ".recording.db";

/// "weekend.db" beside "weekend.recording.db".
Result<std::string> database_beside(const std::string& recording) {
  if (recording.ends_with(recording_ending)) {
    std::string database =
        recording.substr(0, recording.size() - std::char_traits<char>::length(recording_ending)) +
        ".db";
    if (std::filesystem::exists(database)) return database;
    return fail(Errc::storage, fmt::format("{}: no such database to compare with", database),
                "--against says where the campaign's database is");
  }
  return fail(Errc::bad_input,
              fmt::format("{}: does not end in {}: which database does it belong to?", recording,
                          recording_ending),
              "--against says where the campaign's database is");
}

struct Against {
  std::string path;
  std::string shown;
};
/// A database of an older schema is compared as a migrated copy; it stays as it is.
Result<Against> of_present_schema(const std::string& path, const ScratchFolder& folder) {
  const std::string copy = folder / "migrated.db";
  const auto older = copy_if_older(path, copy);
  if (!older) return tl::unexpected(older.error());
  return Against{*older ? copy : path, path};
}

/// The database to compare with: named, inside a capsule (unpacked into the folder), or beside.
Result<Against> database_of(const ReplayRequest& request, const ScratchFolder& folder) {
  if (request.against) return of_present_schema(*request.against, folder);
  auto recording = RecordingDatabase::open_to_read(request.recording);
  if (!recording) return tl::unexpected(recording.error());
  const std::string unpacked = folder / "capsule.db";
  const auto note = take_contents(*recording, unpacked);
  if (!note) return tl::unexpected(note.error());
  if (*note) {
    if (auto migrated = migrate_database(unpacked); !migrated) {
      return tl::unexpected(migrated.error());
    }
    return Against{unpacked, "the database inside (" + **note + ")"};
  }
  auto beside = database_beside(request.recording);
  if (!beside) return tl::unexpected(beside.error());
  return of_present_schema(*beside, folder);
}

using Pass = Result<std::vector<RunResult>>;

/// Every run, until one differs.
Pass replay_all(const std::vector<RunMaterial>& materials, const ScratchFolder& folder,
                const std::string& label) {
  std::vector<RunResult> results;
  for (RunMaterial material : materials) {
    material.database = folder / fmt::format("{}-{}.db", label, material.run.id);
    auto result = replay_run(material);
    if (!result) return tl::unexpected(result.error());
    results.push_back(std::move(*result));
    if (results.back().difference) break;
  }
  return results;
}

/// Whether two replays stored the same.
Result<bool> stored_alike(const std::string& first, const std::string& second) {
  const auto one = open_to_read(first);
  if (!one) return tl::unexpected(one.error());
  const auto other = open_to_read(second);
  if (!other) return tl::unexpected(other.error());
  const auto campaign = one->integer("SELECT max(id) FROM campaign");
  if (!campaign) return tl::unexpected(campaign.error());
  for (const CampaignPart part : all_campaign_parts) {
    const auto compared =
        compare_campaigns({*one, CampaignId{*campaign}}, {*other, CampaignId{*campaign}}, part);
    if (!compared) return tl::unexpected(compared.error());
    if (compared->difference || compared->beyond) return false;
  }
  return true;
}

Result<std::vector<RunMaterial>> materials_of(const ReplayRequest& request,
                                              const std::string& against) {
  const auto runs = recorded_runs(request.recording);
  if (!runs) return tl::unexpected(runs.error());
  if (runs->empty()) {
    return fail(Errc::bad_input, request.recording + ": holds no run",
                "was the campaign killed before it began?");
  }
  std::vector<RunMaterial> materials;
  for (const RecordedRun& run : *runs) {
    auto material = material_of(request.recording, run, request.campaign);
    if (!material) return tl::unexpected(material.error());
    material->against = against;
    for (RunMaterial& earlier : materials) {
      if (material->begun.resumed && !earlier.next) {
        earlier.next = material->begun.resumed->t_last_ns;
      }
    }
    materials.push_back(std::move(*material));
  }
  return materials;
}

}  // namespace

Result<ReplayReport> replay(const ReplayRequest& request) {
  const auto folder = ScratchFolder::make();
  if (!folder) return tl::unexpected(folder.error());
  const auto against = database_of(request, *folder);
  if (!against) return tl::unexpected(against.error());
  const auto materials = materials_of(request, against->path);
  if (!materials) return tl::unexpected(materials.error());

  auto second =
      std::async(std::launch::async, [&] { return replay_all(*materials, *folder, "second"); });
  const Pass first = replay_all(*materials, *folder, "first");
  const Pass again = second.get();
  if (!first) return tl::unexpected(first.error());
  if (!again) return tl::unexpected(again.error());

  ReplayReport report{request.recording, against->shown, {}, {}, *first == *again};
  for (const RunResult& result : *first) {
    report.runs.push_back(result.run);
    report.difference = result.difference;
    if (!report.repeatable) continue;
    const auto alike = stored_alike(*folder / fmt::format("first-{}.db", result.run.number),
                                    *folder / fmt::format("second-{}.db", result.run.number));
    if (!alike) return tl::unexpected(alike.error());
    report.repeatable = *alike;
  }
  return report;
}

}  // namespace gyrocal::replay
