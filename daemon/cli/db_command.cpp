#include <fmt/core.h>

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "daemon/cli/cell_text.h"
#include "daemon/cli/command.h"
#include "daemon/cli/outcome.h"
#include "daemon/cli/schema_text.h"
#include "schema/catalogue.h"
#include "schema/maintenance.h"
#include "schema/store.h"
#include "schema/table_reader.h"

namespace gyrocal::cli {
namespace {

struct DbOptions {
  std::string database;
  std::string target;
  bool as_json = false;
};

Result<nlohmann::ordered_json> summary(const std::string& path) {
  auto progress = TableReader::open(path, "campaign_progress");
  if (!progress) return tl::unexpected(progress.error());
  const auto columns = progress->columns();
  auto campaigns = nlohmann::ordered_json::array();
  std::vector<Cell> row;
  for (;;) {
    const auto more = progress->next(row);
    if (!more) return tl::unexpected(more.error());
    if (!*more) return campaigns;
    campaigns.push_back(to_json(columns, row));
  }
}

std::string axes_of(const BoardRow& board) {
  std::string axes;
  for (const Axis axis : all_axes) {
    if (board.measured.at(static_cast<std::size_t>(axis))) axes += letter(axis);
  }
  return axes;
}

void print_summary(const nlohmann::ordered_json& campaigns, const Store& store) {
  for (const auto& campaign : campaigns) {
    const auto id = campaign["campaign_id"].get<std::int64_t>();
    fmt::print("campaign {} \"{}\": {}, began {}\n", id, campaign["campaign"].get<std::string>(),
               campaign["state"].get<std::string>(),
               campaign["utc_start"].is_null() ? "at an unknown time (imported)"
                                               : campaign["utc_start"].get<std::string>() + " UTC");
    fmt::print("  {} of {} setpoints logged, {} dwells accepted, {} rejected, {} samples\n",
               campaign["setpoints_logged"].dump(), campaign["setpoints"].dump(),
               campaign["dwells_accepted"].dump(), campaign["dwells_rejected"].dump(),
               campaign["samples"].dump());
    const auto boards = store.boards(CampaignId{id});
    if (!boards) continue;
    for (const auto& [board_id, board] : *boards) {
      fmt::print("  board \"{}\" axes {} on {}\n", board.name, axes_of(board), board.device);
    }
  }
}

int show(const DbOptions& options) {
  const auto campaigns = summary(options.database);
  if (!campaigns) return report(campaigns.error());
  const auto store = Store::open_read_only(options.database);
  if (!store) return report(store.error());
  if (options.as_json) {
    fmt::print("{}\n", campaigns->dump());
  } else if (campaigns->empty()) {
    fmt::print("{}: no campaign\n", options.database);
  } else {
    print_summary(*campaigns, *store);
  }
  return exit_done;
}

int check(const DbOptions& options) {
  const auto problems = problems_in_database(options.database);
  if (!problems) return report(problems.error());
  if (options.as_json) {
    fmt::print("{}\n", nlohmann::json{{"problems", *problems}}.dump());
  } else {
    for (const auto& problem : *problems) fmt::print("{}\n", problem);
    if (problems->empty()) fmt::print("{}: sound\n", options.database);
  }
  return problems->empty() ? exit_done : exit_differs;
}

int make_backup(const DbOptions& options) {
  const auto done = backup_database(options.database, options.target);
  if (!done) return report(done.error());
  std::error_code unknown;
  fmt::print("{}: {} bytes\n", options.target, std::filesystem::file_size(options.target, unknown));
  return exit_done;
}

int migrate(const DbOptions& options) {
  const auto done = migrate_database(options.database);
  if (!done) return report(done.error());
  if (done->copy) {
    fmt::print("{}: schema {} to {}; the old one is kept as {}\n", options.database, done->from,
               done->to, *done->copy);
  } else {
    fmt::print("{}: schema {}, nothing to do\n", options.database, done->to);
  }
  return exit_done;
}

int print_schema(const DbOptions& options) {
  const auto present = catalogue();
  if (!present) return report(present.error());
  fmt::print("{}",
             options.as_json ? schema_json(*present).dump() + "\n" : schema_markdown(*present));
  return exit_done;
}

}  // namespace

void add_db(Command& root, Chosen& chosen) {
  auto* command = root.add_subcommand(
      "db",
      "Example: gyrocal db campaign.db\n"
      "         gyrocal db check campaign.db\n"
      "         gyrocal db backup campaign.db copy.db\n"
      "Lists what a database holds, looks for damage, copies it also while a campaign writes, "
      "brings it to the present schema.");
  command->require_subcommand(0, 1);
  const auto options = std::make_shared<DbOptions>();
  const auto on_database = [options](Command& to, bool required) {
    to.add_option("database", options->database, "the database's file")->required(required);
  };
  const auto subcommand = [&](const char* name, const char* help, int (*act)(const DbOptions&)) {
    auto* added = command->add_subcommand(name, help);
    on_database(*added, true);
    added->callback([options, act, &chosen] { chosen = [options, act] { return act(*options); }; });
    return added;
  };
  subcommand("check", "Example: gyrocal db check campaign.db\nExit code 4 if anything is wrong.",
             check)
      ->add_flag("--json", options->as_json, "print JSON");
  subcommand("backup",
             "Example: gyrocal db backup campaign.db copy.db\nOne consistent file; an existing one "
             "is never replaced.",
             make_backup)
      ->add_option("target", options->target, "the copy's file")
      ->required();
  subcommand("migrate",
             "Example: gyrocal db migrate campaign.db\nBrings it to the present schema and keeps a "
             "copy.",
             migrate);
  auto* schema = command->add_subcommand("schema",
                                         "Example: gyrocal db schema > database.md\nEvery table, "
                                         "view and column of the present schema "
                                         "with its meaning, as Markdown.");
  schema->add_flag("--json", options->as_json, "print JSON");
  schema->callback([options, &chosen] { chosen = [options] { return print_schema(*options); }; });

  on_database(*command, false);
  command->add_flag("--json", options->as_json, "print JSON");
  command->callback([options, command, &chosen] {
    if (command->subcommand_given()) return;
    if (options->database.empty()) throw MissingOption("database");
    chosen = [options] { return show(*options); };
  });
}

}  // namespace gyrocal::cli
