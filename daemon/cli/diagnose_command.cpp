#include <fmt/core.h>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <memory>

#include "compensation/discrepancy/diagnosis.h"
#include "config/rig_model.h"
#include "daemon/cli/command.h"
#include "daemon/cli/diagnosis_json.h"
#include "daemon/cli/outcome.h"
#include "schema/session/session_csv.h"
#include "schema/store.h"

namespace gyrocal::cli {
namespace {

struct Options {
  std::string session, database, board, axis = "z";
  std::string rig_model = default_rig_model, write_rig_model, prediction;
  int jobs = 1;
  bool json = false, verdict_as_exit_code = false;
};

constexpr int exit_explained = 10, exit_unexplained = 11, exit_confounded = 12;

Result<Session> session_of_database(const Options& options) {
  auto store = Store::open_read_only(options.database);
  if (!store) return tl::unexpected(store.error());
  const auto campaign = store->latest_campaign();
  if (!campaign) return tl::unexpected(campaign.error());
  if (!*campaign) {
    return fail(Errc::bad_input, fmt::format("{}: holds no campaign", options.database));
  }
  const auto boards = store->boards(**campaign);
  if (!boards) return tl::unexpected(boards.error());
  std::string names;
  for (const auto& [id, board] : *boards) {
    if (options.board.empty() || board.name == options.board) {
      const Axis axis = options.axis == "x" ? Axis::x : options.axis == "y" ? Axis::y : Axis::z;
      return store->session(**campaign, id, axis);
    }
    names += (names.empty() ? "" : ", ") + board.name;
  }
  return fail(Errc::unknown_name, fmt::format("{}: no board \"{}\"; there are: {}",
                                              options.database, options.board, names));
}

Result<void> write_text(const std::string& path, const std::string& text) {
  std::ofstream out(path, std::ios::binary | std::ios::trunc);
  out << text;
  out.close();
  if (!out) {
    return fail(Errc::storage, fmt::format("{}: cannot be written", path),
                "does the folder exist, is there room?");
  }
  return {};
}

std::string prediction_csv(const Diagnosis& diagnosis) {
  std::string text = "t_s,measured_dps,before_dps,after_dps\n";
  for (const PredictionRow& row : diagnosis.prediction) {
    const std::string measured =
        std::isnan(row.measured_dps) ? "" : fmt::format("{}", row.measured_dps);
    text += fmt::format("{},{},{},{}\n", row.t_s, measured, row.before_dps, row.after_dps);
  }
  return text;
}

int verdict_code(Verdict verdict) {
  switch (verdict) {
    case Verdict::consistent:
      return exit_done;
    case Verdict::explained:
      return exit_explained;
    case Verdict::unexplained:
      return exit_unexplained;
    case Verdict::confounded:
      return exit_confounded;
  }
  return exit_failed;
}

int run(const Options& options) {
  const auto model = read_rig_model(options.rig_model);
  if (!model) return report(model.error());
  const auto session =
      options.database.empty() ? read_session(options.session) : session_of_database(options);
  if (!session) return report(session.error());
  auto diagnosis = diagnose(*session, *model, {.jobs = options.jobs});
  if (!diagnosis) return report(diagnosis.error());
  if (!options.prediction.empty()) {
    if (auto written = write_text(options.prediction, prediction_csv(*diagnosis)); !written) {
      return report(written.error());
    }
  }
  if (!options.write_rig_model.empty()) {
    diagnosis->model.parent_hash = rig_model_hash(*model);
    const auto written = write_text(options.write_rig_model, rig_model_to_json(diagnosis->model));
    if (!written) return report(written.error());
  }
  if (options.json) {
    fmt::print("{}\n", to_json(*diagnosis).dump());
  } else {
    fmt::print("{}", to_text(*diagnosis));
  }
  return options.verdict_as_exit_code ? verdict_code(diagnosis->verdict) : exit_done;
}

}  // namespace

void add_diagnose(CLI::App& root, Chosen& chosen) {
  auto* command = root.add_subcommand(
      "diagnose",
      "Example: gyrocal diagnose --session DIR --json\n"
      "Example: gyrocal diagnose --db weekend.db --board A --axis z --write-rig-model better.json\n"
      "Compares a measured session with the simulated rig, names what the simulation lacks and "
      "shows on kept-out dwells how much the gap shrinks.");
  const auto options = std::make_shared<Options>();
  auto* session = command->add_option("--session", options->session, "a session directory");
  auto* database = command->add_option("--db", options->database, "a campaign's database");
  session->excludes(database);
  command->add_option("--board", options->board, "with --db: the board's name (the first one)");
  command->add_option("--axis", options->axis, "with --db: x, y or z (z)")
      ->check(CLI::IsMember({"x", "y", "z"}));
  command->add_option("--rig-model", options->rig_model, "file, or the name of a shipped model");
  command->add_option("--write-rig-model", options->write_rig_model,
                      "write the model with what was found added");
  command->add_option("--prediction", options->prediction,
                      "write t_s,measured_dps,before_dps,after_dps for every monitor row");
  command
      ->add_option("--jobs", options->jobs,
                   "threads (one is used so far); the answer does not depend on it")
      ->check(CLI::Range(1, 256));
  command->add_flag("--json", options->json, "print JSON");
  command->add_flag("--exit-code", options->verdict_as_exit_code,
                    "exit 0 consistent, 10 explained, 11 unexplained, 12 confounded");
  command->callback([options, session, database, &chosen] {
    if (session->empty() && database->empty()) {
      throw CLI::RequiredError("--session DIR or --db FILE");
    }
    chosen = [options] { return run(*options); };
  });
}

}  // namespace gyrocal::cli
