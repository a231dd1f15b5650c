#pragma once

#include <string>

#include "compensation/discrepancy/diagnosis.h"
#include "compensation/values/records.h"

namespace gyrocal::report {

/// What stands above a diagnosis.
struct DiagnosisSource {
  std::string session;    ///< folder or database, board and axis
  std::string rig_model;  ///< as it was given
  std::string software_version;
};

/// A diagnosis as one HTML file: verdict, findings, the candidates held against each, gap, course
/// and residual over time, temperature and direction, spectra, detection limits.
/// @return the errors of svg_of().
[[nodiscard]] Result<std::string> diagnosis_report(const Session& session,
                                                   const Diagnosis& diagnosis,
                                                   const DiagnosisSource& source);

}  // namespace gyrocal::report
