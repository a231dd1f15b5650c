#pragma once

#include "compensation/discrepancy/diagnosis.h"
#include "compensation/rig/rig_model.h"
#include "schema/store.h"

namespace gyrocal::cli {

/// What was compared, by whom and from where.
struct DiagnosedSession {
  BoardId board{};
  Axis axis = Axis::z;
  std::string source;  ///< as a person names it
  std::string software_version;
};

/// Stores both rig models (one that is there already is not stored again), the diagnosis and its
/// findings; the view gap_history then shows the steps.
/// @return the errors of Store.
[[nodiscard]] Result<void> store_diagnosis(Store& store, const DiagnosedSession& session,
                                           const rig::RigModel& before, const Diagnosis& diagnosis);

}  // namespace gyrocal::cli
