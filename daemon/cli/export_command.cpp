#include <fmt/core.h>

#include <cstdio>
#include <memory>

#include "daemon/cli/cell_text.h"
#include "daemon/cli/command.h"
#include "daemon/cli/database_choice.h"
#include "daemon/cli/outcome.h"
#include "schema/session/session_csv.h"
#include "schema/table_reader.h"

namespace gyrocal::cli {
namespace {

struct ExportOptions {
  DatabaseChoice choice;
  std::string folder;
  std::string table;
  bool as_json = false;
};

Result<void> put(const std::string& line) {
  if (std::fwrite(line.data(), 1, line.size(), stdout) == line.size()) return {};
  return fail(Errc::storage, "write to standard output: it was closed or its disk is full");
}

int export_table(const ExportOptions& options) {
  auto reader = TableReader::open(options.choice.database, options.table);
  if (!reader) return report(reader.error());
  const auto columns = reader->columns();
  const std::string head = to_csv({columns.begin(), columns.end()}) + '\n';
  auto written = put(options.as_json ? "[" : head);
  std::vector<Cell> row;
  for (const char* before = "\n"; written; before = ",\n") {
    const auto more = reader->next(row);
    if (!more) return report(more.error());
    if (!*more) break;
    written = put(options.as_json ? before + to_json(columns, row).dump() : to_csv(row) + '\n');
  }
  if (options.as_json && written) written = put("]\n");
  return written ? exit_done : report(written.error());
}

int export_session(const ExportOptions& options) {
  const auto store = Store::open_read_only(options.choice.database);
  if (!store) return report(store.error());
  const auto chosen = choose_board(*store, options.choice);
  if (!chosen) return report(chosen.error());
  const auto session = store->session(chosen->campaign, chosen->board, chosen->axis);
  if (!session) return report(session.error());
  const auto written = write_session(options.folder, *session);
  if (!written) return report(written.error());
  const auto campaign = static_cast<std::int64_t>(chosen->campaign);
  if (options.as_json) {
    fmt::print("{}\n", nlohmann::ordered_json{{"session", options.folder},
                                              {"campaign_id", campaign},
                                              {"board", chosen->row.name},
                                              {"axis", std::string(1, letter(chosen->axis))},
                                              {"dwells", session->dwells.size()},
                                              {"samples", session->samples.size()},
                                              {"monitor_rows", session->monitor.size()}}
                           .dump());
  } else {
    fmt::print("{}: campaign {}, board \"{}\", axis {}: {} dwells, {} samples, {} monitor rows\n",
               options.folder, campaign, chosen->row.name, letter(chosen->axis),
               session->dwells.size(), session->samples.size(), session->monitor.size());
  }
  return exit_done;
}

}  // namespace

void add_export(Command& root, Chosen& chosen) {
  auto* command = root.add_subcommand(
      "export",
      "Example: gyrocal export --db demo.db --table zero_drift > drift.csv\n"
      "         gyrocal export --db demo.db --board board0 --axis z --session monday\n"
      "Prints a table or view as CSV, units in the names, or writes one board and axis of a "
      "campaign as a session directory (session-csv/1).");
  const auto options = std::make_shared<ExportOptions>();
  command->add_option("--db", options->choice.database, "the database")->required();
  auto* table = command->add_option("--table", options->table, "a table or view");
  auto* session = command->add_option("--session", options->folder, "directory to write");
  table->excludes(session);
  add_choice_options(*command, options->choice);
  command->add_flag("--json", options->as_json, "print JSON");
  command->callback([options, &chosen] {
    if (options->table.empty() == options->folder.empty()) {
      throw MissingOption("--table or --session");
    }
    chosen = [options] {
      return options->table.empty() ? export_session(*options) : export_table(*options);
    };
  });
}

}  // namespace gyrocal::cli
