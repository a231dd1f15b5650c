#include "daemon/cli/diagnosis_subjects.h"

#include <fmt/core.h>

#include <array>
#include <cstdio>

#include "daemon/cli/axis_name.h"
#include "daemon/cli/diagnosis_rows.h"
#include "daemon/cli/one_of.h"
#include "daemon/cli/worker_threads.h"
#include "gyrocal_version.h"
#include "schema/session/session_csv.h"

namespace gyrocal::cli {
namespace {

constexpr std::array<const char*, 3> axis_names{"x", "y", "z"};

}  // namespace

Result<std::vector<Subject>> subjects_of_database(const std::string& database,
                                                  const std::optional<WantedAxis>& wanted) {
  auto store = Store::open_read_only(database);
  if (!store) return tl::unexpected(store.error());
  const auto campaign = store->latest_campaign();
  if (!campaign) return tl::unexpected(campaign.error());
  if (!*campaign) {
    return fail(Errc::bad_input, fmt::format("{}: holds no campaign", database));
  }
  const auto boards = store->boards(**campaign);
  if (!boards) return tl::unexpected(boards.error());
  std::vector<Subject> subjects;
  std::vector<std::string> names;
  for (const auto& [id, board] : *boards) {
    names.push_back(board.name);
    if (wanted && !wanted->board.empty() && board.name != wanted->board) continue;
    for (std::size_t k = 0; k < axis_names.size(); ++k) {
      if (!(wanted ? axis_names[k] == wanted->axis : board.measured[k])) continue;
      auto session = store->session(**campaign, id, axis_named(axis_names[k]));
      if (!session) return tl::unexpected(session.error());
      subjects.push_back({board.name, axis_names[k], id, *std::move(session)});
    }
    if (wanted) break;
  }
  if (!subjects.empty()) return subjects;
  const std::string asked = wanted ? wanted->board : "";
  return fail(Errc::unknown_name, fmt::format("{}: no board \"{}\"", database, asked),
              one_of(asked, "there are", names));
}

Result<std::vector<Subject>> subject_of_directory(const std::string& folder) {
  auto session = read_session(folder);
  if (!session) return tl::unexpected(session.error());
  std::vector<Subject> one;
  one.push_back({session->device, session->axis, std::nullopt, *std::move(session)});
  return one;
}

Result<void> store_diagnoses(const std::string& database, const std::vector<Subject>& subjects,
                             const rig::RigModel& model,
                             const std::vector<AxisDiagnosis>& diagnoses) {
  auto store = Store::open(database);
  if (!store && store.error().code == Errc::busy) {
    fmt::print(stderr, "not stored: {}\n", store.error().what);
    return {};
  }
  if (!store) return tl::unexpected(store.error());
  for (std::size_t i = 0; i < subjects.size(); ++i) {
    const Subject& subject = subjects[i];
    const DiagnosedSession session{*subject.id, axis_named(subject.axis),
                                   subject.board + "/" + subject.axis, GYROCAL_VERSION};
    if (auto stored = store_diagnosis(*store, session, model, diagnoses[i].diagnosis); !stored) {
      return stored;
    }
  }
  return {};
}

Result<std::vector<AxisDiagnosis>> diagnose_all(const std::vector<Subject>& subjects,
                                                const rig::RigModel& model, int jobs) {
  // Several axes are shared out whole, a single one in its parts.
  const bool several = subjects.size() > 1;
  const DiagnoseOptions options{several ? Executor(run_in_turn) : worker_threads(jobs)};
  std::vector<Result<Diagnosis>> found(subjects.size(), fail(Errc::bad_input, std::string()));
  const auto one = [&](std::size_t i) { found[i] = diagnose(subjects[i].session, model, options); };
  several ? worker_threads(jobs)(subjects.size(), one) : run_in_turn(subjects.size(), one);
  std::vector<AxisDiagnosis> diagnoses;
  for (std::size_t i = 0; i < subjects.size(); ++i) {
    if (!found[i]) return tl::unexpected(found[i].error());
    diagnoses.push_back({subjects[i].board, subjects[i].axis, *std::move(found[i])});
  }
  return diagnoses;
}

}  // namespace gyrocal::cli
