#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "daemon/cli/command.h"
#include "daemon/cli/outcome.h"
#include "gyrocal_version.h"
#include "schema/session/import_session.h"
#include "schema/session/session_csv.h"
#include "schema/store.h"

namespace gyrocal::cli {
namespace {

struct ImportOptions {
  std::string folder;
  std::string database;
  std::string name;
  bool as_json = false;
};

/// What the directory holds and the database has no place for.
void say_what_is_left_out(const Session& session) {
  const auto any = [&](auto measured) {
    return std::any_of(session.samples.begin(), session.samples.end(), measured);
  };
  if (any([](const SessionSample& s) { return !std::isnan(s.acc_g[0]); })) {
    fmt::print(stderr, "not imported: the accelerometer's columns\n");
  }
  if (any([](const SessionSample& s) { return !std::isnan(s.chamber_c); })) {
    fmt::print(stderr, "not imported: chamber_c of single samples; each dwell keeps its mean\n");
  }
}

int import(const ImportOptions& options) {
  const auto session = read_session(options.folder);
  if (!session) return report(session.error());
  auto store = Store::open(options.database);
  if (!store) return report(store.error());
  const auto folder = std::filesystem::path(options.folder).lexically_normal();
  const auto base = folder.has_filename() ? folder.filename() : folder.parent_path().filename();
  const ImportNames names{options.name.empty() ? base.string() : options.name, options.folder,
                          GYROCAL_VERSION};
  const auto campaign = import_session(*store, *session, names);
  if (!campaign) return report(campaign.error());
  say_what_is_left_out(*session);
  const auto id = static_cast<std::int64_t>(*campaign);
  if (options.as_json) {
    fmt::print("{}\n", nlohmann::ordered_json{{"database", options.database},
                                              {"campaign_id", id},
                                              {"campaign", names.campaign},
                                              {"dwells", session->dwells.size()},
                                              {"samples", session->samples.size()},
                                              {"monitor_rows", session->monitor.size()}}
                           .dump());
  } else {
    fmt::print("{}: campaign {} \"{}\", {} dwells, {} samples, {} monitor rows\n", options.database,
               id, names.campaign, session->dwells.size(), session->samples.size(),
               session->monitor.size());
  }
  return exit_done;
}

}  // namespace

void add_import(Command& root, Chosen& chosen) {
  auto* command = root.add_subcommand(
      "import",
      "Example: gyrocal import sessions/monday --db lab.db\n"
      "Stores a session directory (session-csv/1) as a finished campaign of one board and axis. "
      "Its rates must be whole counts of its lsb_dps.");
  const auto options = std::make_shared<ImportOptions>();
  command->add_option("session", options->folder, "the session directory")->required();
  command->add_option("--db", options->database, "the database, made if it is not there")
      ->required();
  command->add_option("--name", options->name, "name of the campaign; default: the directory's");
  command->add_flag("--json", options->as_json, "print JSON");
  command->callback([options, &chosen] { chosen = [options] { return import(*options); }; });
}

}  // namespace gyrocal::cli
