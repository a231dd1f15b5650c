#pragma once

#include <optional>
#include <string>
#include <vector>

#include "compensation/discrepancy/coherence.h"
#include "compensation/values/error.h"
#include "compensation/values/records.h"
#include "schema/store.h"

namespace gyrocal::cli {

/// One axis of one board to be diagnosed.
struct Subject {
  std::string board, axis;
  std::optional<BoardId> id;  ///< absent: a session directory
  Session session;
};

/// Which one; an empty board is the first.
struct WantedAxis {
  std::string board, axis;
};

[[nodiscard]] Result<std::vector<Subject>> subject_of_directory(const std::string& folder);

/// Of the latest campaign: the wanted one, or every measured axis of every board.
[[nodiscard]] Result<std::vector<Subject>> subjects_of_database(
    const std::string& database, const std::optional<WantedAxis>& wanted);

/// Each by itself, in the subjects' order whatever the number of threads.
[[nodiscard]] Result<std::vector<AxisDiagnosis>> diagnose_all(const std::vector<Subject>& subjects,
                                                              const rig::RigModel& model, int jobs);

/// Into the database they came from. While a campaign writes there, nothing is stored, and stderr
/// says so: the answer is worth printing all the same.
[[nodiscard]] Result<void> store_diagnoses(const std::string& database,
                                           const std::vector<Subject>& subjects,
                                           const rig::RigModel& model,
                                           const std::vector<AxisDiagnosis>& diagnoses);

}  // namespace gyrocal::cli
