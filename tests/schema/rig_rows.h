#pragma once

#include <string>

#include "schema/store.h"

/// A rig model and a diagnosis that found one effect.
namespace rig_rows {

inline gyrocal::RigModelRow model(const std::string& name, const std::string& sha256) {
  const std::string empty(2, ' ');
  return {name, sha256, std::nullopt, "{" + empty + "}", "{" + empty + "}", std::string("0.1.0"),
          {}};
}

inline gyrocal::DiagnosisInsert diagnosis(gyrocal::RigModelId before, gyrocal::RigModelId after) {
  gyrocal::DiagnosisInsert row;
  row.source = std::string("sessions/monday");
  row.model_before = before;
  row.model_after = after;
  row.verdict = std::string("explained");
  row.gap_before = 6.5;
  row.gap_after = 0.4;
  row.report_json = std::string("{}");
  row.software_version = std::string("0.1.0");
  gyrocal::FindingRow finding;
  finding.effect = std::string("thermal_hysteresis");
  finding.amplitude = 0.08;
  finding.unit = std::string("deg/s");
  finding.parameters_json = std::string("{}");
  finding.confounded_with_json = std::string("[]");
  finding.description = std::string("the drift lags the temperature by a constant width");
  finding.gap_before = 6.5;
  finding.gap_after = 0.4;
  row.findings = {finding};
  return row;
}

}  // namespace rig_rows
