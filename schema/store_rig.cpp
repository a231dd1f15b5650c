// Rig models and what diagnoses found.
#include <fmt/core.h>

#include "schema/store_impl.h"

namespace gyrocal {
namespace {

Result<std::optional<RigModelId>> model_with(const Database& database, const std::string& sha256) {
  std::optional<RigModelId> found;
  const auto read = for_each_row(
      database, "SELECT id FROM rig_model WHERE sha256 = ?",
      [&](const Statement& row) { found = RigModelId{row.integer(0)}; }, sha256);
  if (!read) return tl::unexpected(read.error());
  return found;
}

std::optional<std::int64_t> key_if(const std::optional<RigModelId>& id) {
  return id ? std::optional(key(*id)) : std::nullopt;
}

Result<RigModelId> insert_model(const Database& database, const RigModelRow& model) {
  const auto done = run(database,
                        "INSERT INTO rig_model (name, sha256, parent_id, baseline_json, "
                        "model_json, software_version) VALUES (?, ?, ?, ?, ?, ?)",
                        model.name, model.sha256, key_if(model.parent), model.baseline_json,
                        model.model_json, model.software_version);
  if (!done) return tl::unexpected(done.error());
  const RigModelId id{database.last_insert_id()};
  auto insert = database.prepare(
      "INSERT INTO rig_effect (rig_model_id, position, effect, law, parameters_json) "
      "VALUES (?, ?, ?, ?, ?)");
  if (!insert) return tl::unexpected(insert.error());
  for (std::size_t i = 0; i < model.effects.size(); ++i) {
    const RigEffectRow& effect = model.effects[i];
    const auto added = insert->run(key(id), static_cast<std::int64_t>(i), effect.effect, effect.law,
                                   effect.parameters_json);
    if (!added) return tl::unexpected(added.error());
  }
  return id;
}

Result<void> add_findings(const Database& database, std::int64_t diagnosis,
                          std::span<const FindingRow> findings) {
  auto insert = database.prepare(
      "INSERT INTO finding (diagnosis_id, position, effect, amplitude, unit, standard_error, "
      "parameters_json, evidence_nats, lead_nats, confounded_with_json, tell_apart, description, "
      "gap_before, gap_after) VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)");
  if (!insert) return tl::unexpected(insert.error());
  for (std::size_t i = 0; i < findings.size(); ++i) {
    const FindingRow& f = findings[i];
    auto done =
        insert->run(diagnosis, static_cast<std::int64_t>(i), f.effect, f.amplitude, f.unit,
                    f.standard_error, f.parameters_json, f.evidence_nats, f.lead_nats,
                    f.confounded_with_json, f.tell_apart, f.description, f.gap_before, f.gap_after);
    if (!done) return done;
  }
  return {};
}

}  // namespace

Result<RigModelId> Store::add_rig_model(const RigModelRow& model) {
  RigModelId id{};
  const auto stored =
      impl_->write(fmt::format("rig model \"{}\"", model.name), [&]() -> Result<void> {
        const auto there = model_with(impl_->database, model.sha256);
        if (!there) return tl::unexpected(there.error());
        const auto chosen =
            *there ? Result<RigModelId>(**there) : insert_model(impl_->database, model);
        if (!chosen) return tl::unexpected(chosen.error());
        id = *chosen;
        return {};
      });
  if (!stored) return tl::unexpected(stored.error());
  return id;
}

Result<void> Store::add_diagnosis(const DiagnosisInsert& d) {
  return impl_->write("the diagnosis of " + d.source, [&]() -> Result<void> {
    const auto board = d.board ? std::optional(key(*d.board)) : std::nullopt;
    auto done = run(impl_->database,
                    "INSERT INTO diagnosis (board_id, axis, source, rig_model_before_id, "
                    "rig_model_after_id, verdict, gap_before, gap_after, report_json, "
                    "software_version) VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?)",
                    board, name_of(d.axis), d.source, key(d.model_before), key(d.model_after),
                    d.verdict, d.gap_before, d.gap_after, d.report_json, d.software_version);
    if (!done) return done;
    return add_findings(impl_->database, impl_->database.last_insert_id(), d.findings);
  });
}

Result<std::vector<std::pair<RigModelId, RigModelRow>>> Store::rig_models() const {
  std::vector<std::pair<RigModelId, RigModelRow>> models;
  auto read = for_each_row(
      impl_->database,
      "SELECT id, name, sha256, parent_id, baseline_json, model_json, software_version "
      "FROM rig_model ORDER BY id",
      [&](const Statement& row) {
        const auto parent =
            row.is_null(3) ? std::nullopt : std::optional(RigModelId{row.integer(3)});
        models.emplace_back(
            RigModelId{row.integer(0)},
            RigModelRow{
                row.text(1), row.text(2), parent, row.text(4), row.text(5), row.text(6), {}});
      });
  for (auto& [id, model] : models) {
    if (!read) break;
    auto& effects = model.effects;
    read = for_each_row(
        impl_->database,
        "SELECT effect, law, parameters_json FROM rig_effect WHERE rig_model_id = ? "
        "ORDER BY position",
        [&](const Statement& row) {
          effects.push_back({row.text(0), row.text(1), row.text(2)});
        },
        key(id));
  }
  if (!read) return tl::unexpected(read.error());
  return models;
}

}  // namespace gyrocal
