#include <fmt/core.h>

#include <cmath>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>

#include "compensation/discrepancy/coherence.h"
#include "compensation/discrepancy/diagnosis.h"
#include "config/rig_model.h"
#include "daemon/cli/axis_name.h"
#include "daemon/cli/command.h"
#include "daemon/cli/diagnosis_json.h"
#include "daemon/cli/diagnosis_subjects.h"
#include "daemon/cli/outcome.h"
#include "daemon/cli/plan_file.h"
#include "daemon/cli/text_output.h"
#include "daemon/report/diagnosis_report.h"
#include "gyrocal_version.h"
#include "schema/store.h"

namespace gyrocal::cli {
namespace {

struct DiagnoseRequest {
  std::string session, database, board, axis = "z";
  std::string rig_model = default_rig_model, write_rig_model, prediction, report, write_plan;
  std::string campaign;  ///< file of the campaign the session comes from, for write_plan
  int jobs = 1;
  bool all = false, json = false, verdict_as_exit_code = false;
};

std::optional<WantedAxis> wanted_of(const DiagnoseRequest& options) {
  if (options.all) return std::nullopt;
  return WantedAxis{options.board, options.axis};
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

Result<void> write_report(const DiagnoseRequest& options, const Session& session,
                          const Diagnosis& diagnosis) {
  const std::string source = options.database.empty()
                                 ? options.session
                                 : fmt::format("{}, {}", options.database, options.board);
  const auto html = report::diagnosis_report(
      session, diagnosis,
      {fmt::format("{}, axis {}", source, session.axis), options.rig_model, GYROCAL_VERSION});
  if (!html) return tl::unexpected(html.error());
  return write_text_file(options.report, *html);
}

/// The campaign whose plan left names open: the database's own, or the file given.
Result<CampaignConfig> campaign_of(const DiagnoseRequest& options) {
  if (!options.campaign.empty()) return read_campaign(options.campaign);
  auto store = Store::open_read_only(options.database);
  if (!store) return tl::unexpected(store.error());
  const auto latest = store->latest_campaign();
  if (!latest) return tl::unexpected(latest.error());
  const auto row = store->campaign(latest->value());
  if (!row) return tl::unexpected(row.error());
  return parse_campaign(row->config_toml, options.database + ": its campaign file");
}

/// A campaign file that would tell apart the names this session leaves open.
Result<void> write_plan(const DiagnoseRequest& options, const Diagnosis& diagnosis,
                        const rig::RigModel& model, const std::string& axis_name) {
  std::vector<EffectPair> open;
  for (const Finding& finding : diagnosis.findings) {
    for (const std::string& rival : finding.confounded_with) {
      open.emplace_back(finding.effect, rival);
    }
  }
  if (open.empty()) {
    fmt::print(stderr, "no name is left open: {} is not written\n", options.write_plan);
    return {};
  }
  const auto campaign = campaign_of(options);
  if (!campaign) return tl::unexpected(campaign.error());
  const rig::SessionPlan plan = session_plan(*campaign);
  const Axis axis = axis_named(axis_name);
  const auto contrast = plan_contrast(plan, model, axis);
  if (!contrast) return tl::unexpected(contrast.error());
  const auto additions = plan_additions(plan, model, axis, *contrast);
  if (!additions) return tl::unexpected(additions.error());
  const auto text = campaign_with_best(*campaign, *additions, open);
  if (!text) return tl::unexpected(text.error());
  return write_text_file(options.write_plan, *text);
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

Result<void> write_files(const DiagnoseRequest& options, const rig::RigModel& model,
                         const Subject& subject, Diagnosis& diagnosis) {
  diagnosis.model.parent_hash = rig_model_hash(model);
  Result<void> written;
  if (!options.prediction.empty()) {
    written = write_text_file(options.prediction, prediction_csv(diagnosis));
  }
  if (written && !options.write_rig_model.empty()) {
    written = write_text_file(options.write_rig_model, rig_model_to_json(diagnosis.model));
  }
  if (written && !options.report.empty()) {
    written = write_report(options, subject.session, diagnosis);
  }
  if (written && !options.write_plan.empty()) {
    written = write_plan(options, diagnosis, model, subject.axis);
  }
  return written;
}

int run(const DiagnoseRequest& options) {
  const auto model = read_rig_model(options.rig_model);
  if (!model) return report(model.error());
  const auto subjects = options.database.empty()
                            ? subject_of_directory(options.session)
                            : subjects_of_database(options.database, wanted_of(options));
  if (!subjects) return report(subjects.error());
  auto diagnoses = diagnose_all(*subjects, *model, options.jobs);
  if (!diagnoses) return report(diagnoses.error());
  for (std::size_t i = 0; i < subjects->size(); ++i) {
    const auto written = write_files(options, *model, (*subjects)[i], (*diagnoses)[i].diagnosis);
    if (!written) return report(written.error());
  }
  if (options.all) {
    const auto shared = compare_boards(*diagnoses);
    fmt::print("{}", options.json ? to_json(*diagnoses, shared).dump() + "\n"
                                  : to_text(*diagnoses, shared));
  } else {
    const Diagnosis& diagnosis = diagnoses->front().diagnosis;
    fmt::print("{}", options.json ? to_json(diagnosis).dump() + "\n" : to_text(diagnosis));
  }
  if (!options.database.empty()) {
    if (auto stored = store_diagnoses(options.database, *subjects, *model, *diagnoses); !stored) {
      return report(stored.error());
    }
  }
  return options.verdict_as_exit_code ? verdict_code(diagnoses->front().diagnosis.verdict)
                                      : exit_done;
}

}  // namespace

void add_diagnose(Command& root, Chosen& chosen) {
  auto* command = root.add_subcommand(
      "diagnose",
      "Example: gyrocal diagnose --session DIR --json\n"
      "Example: gyrocal diagnose --db weekend.db --board A --axis z --write-rig-model better.json\n"
      "Example: gyrocal diagnose --db weekend.db --all --jobs 2\n"
      "Compares a measured session with the simulated rig, names what the simulation lacks and "
      "shows on kept-out dwells how much the gap shrinks. With --db the diagnosis is kept in the "
      "database (view gap_history).");
  const auto options = std::make_shared<DiagnoseRequest>();
  auto* session = command->add_option("--session", options->session, "a session directory");
  auto* database = command->add_option("--db", options->database, "a campaign's database");
  session->excludes(database);
  auto* board =
      command->add_option("--board", options->board, "with --db: the board's name (the first one)");
  auto* axis = command->add_option("--axis", options->axis, "with --db: x, y or z (z)")
                   ->one_of({"x", "y", "z"});
  auto* all = command->add_flag("--all", options->all,
                                "with --db: every board and axis, and which effects they share "
                                "(environment) or not (device)");
  all->needs(database)->excludes(board)->excludes(axis);
  command->add_option("--rig-model", options->rig_model, "file, or the name of a shipped model");
  command
      ->add_option("--write-rig-model", options->write_rig_model,
                   "write the model with what was found added")
      ->excludes(all);
  command
      ->add_option("--prediction", options->prediction,
                   "write t_s,measured_dps,before_dps,after_dps for every monitor row")
      ->excludes(all);
  command->add_option("--report", options->report, "write what was found as one HTML file")
      ->excludes(all);
  auto* write_plan = command->add_option(
      "--write-plan", options->write_plan,
      "where names are left open: write a campaign file that would tell them apart");
  auto* campaign = command->add_option("--campaign", options->campaign,
                                       "the session's campaign file; default: the database's");
  write_plan->excludes(all);
  campaign->needs(write_plan);
  command->add_option("--jobs", options->jobs, "threads; the answer does not depend on it")
      ->within(1, 256);
  command->add_flag("--json", options->json, "print JSON");
  command
      ->add_flag("--exit-code", options->verdict_as_exit_code,
                 "exit 0 consistent, 10 explained, 11 unexplained, 12 confounded")
      ->excludes(all);
  command->callback([options, session, database, write_plan, campaign, &chosen] {
    if (!session->given() && !database->given()) {
      throw MissingOption("--session DIR or --db FILE");
    }
    if (write_plan->given() && !database->given() && !campaign->given()) {
      throw MissingOption("--campaign FILE, for --write-plan of a session directory");
    }
    chosen = [options] { return run(*options); };
  });
}

}  // namespace gyrocal::cli
