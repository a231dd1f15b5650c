#include "daemon/cli/diagnosis_rows.h"

#include <cmath>
#include <cstdint>
#include <vector>

#include "config/rig_model.h"
#include "daemon/cli/diagnosis_json.h"
#include "daemon/runner/sha256.h"

namespace gyrocal::cli {
namespace {

using Json = nlohmann::ordered_json;

Json parameters_json(const std::vector<std::pair<std::string, double>>& parameters) {
  Json json = Json::object();
  for (const auto& [name, value] : parameters) {
    json[name] = std::isfinite(value) ? Json(value) : Json(nullptr);
  }
  return json;
}

RigModelRow row_of(const rig::RigModel& model, std::optional<RigModelId> parent,
                   const std::string& software_version) {
  RigModelRow row;
  row.name = model.name;
  row.parent = parent;
  row.model_json = rig_model_to_json(model);
  const std::vector<std::uint8_t> bytes(row.model_json.begin(), row.model_json.end());
  runner::Sha256 hash;
  hash.add(bytes);
  row.sha256 = hash.finish();
  row.baseline_json = Json::parse(row.model_json).at("baseline").dump();
  row.software_version = software_version;
  for (const rig::EffectUse& use : model.effects) {
    row.effects.push_back({use.effect, use.law, parameters_json(use.parameters).dump()});
  }
  return row;
}

/// The gap before and after the step that added a finding. What two channels saw of one effect was
/// one finding and several steps: from the first to the last.
void put_gaps(const std::vector<GapStep>& steps, const std::string& effect, FindingRow& row) {
  for (std::size_t k = 1; k < steps.size(); ++k) {
    if (steps[k].added != effect) continue;
    if (std::isnan(row.gap_before)) row.gap_before = steps[k - 1].gap;
    row.gap_after = steps[k].gap;
  }
}

FindingRow row_of(const Finding& finding, const std::vector<GapStep>& steps) {
  FindingRow row;
  row.effect = finding.effect;
  row.amplitude = finding.amplitude;
  row.unit = finding.unit;
  row.standard_error = finding.standard_error;
  row.parameters_json = parameters_json(finding.parameters).dump();
  row.evidence_nats = finding.evidence_nats;
  row.lead_nats = finding.lead_nats;
  row.confounded_with_json = Json(finding.confounded_with).dump();
  row.tell_apart = finding.tell_apart;
  row.description = finding.description;
  put_gaps(steps, finding.effect, row);
  return row;
}

}  // namespace

Result<void> store_diagnosis(Store& store, const DiagnosedSession& session,
                             const rig::RigModel& before, const Diagnosis& diagnosis) {
  const auto before_id =
      store.add_rig_model(row_of(before, std::nullopt, session.software_version));
  if (!before_id) return tl::unexpected(before_id.error());
  const auto after_id =
      store.add_rig_model(row_of(diagnosis.model, *before_id, session.software_version));
  if (!after_id) return tl::unexpected(after_id.error());
  DiagnosisInsert insert;
  insert.board = session.board;
  insert.axis = session.axis;
  insert.source = session.source;
  insert.model_before = *before_id;
  insert.model_after = *after_id;
  insert.verdict = gyrocal::to_text(diagnosis.verdict);
  insert.gap_before = diagnosis.gap.before;
  insert.gap_after = diagnosis.gap.after;
  insert.report_json = to_json(diagnosis).dump();
  insert.software_version = session.software_version;
  for (const Finding& finding : diagnosis.findings) {
    insert.findings.push_back(row_of(finding, diagnosis.steps));
  }
  return store.add_diagnosis(insert);
}

}  // namespace gyrocal::cli
