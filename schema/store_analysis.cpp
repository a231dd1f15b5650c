// Results: zero drifts and models, with what they were made from.
#include <fmt/core.h>

#include "schema/store_impl.h"

namespace gyrocal {
namespace {

Result<std::int64_t> renew_analysis(const Database& database, CampaignId campaign,
                                    const AnalysisSettings& settings) {
  auto done = run(database,
                  "DELETE FROM analysis WHERE campaign_id = ? AND settings_json = ? AND "
                  "software_version = ?",
                  key(campaign), settings.settings_json, settings.software_version);
  if (done) {
    done = run(database,
               "INSERT INTO analysis (campaign_id, settings_json, software_version) "
               "VALUES (?, ?, ?)",
               key(campaign), settings.settings_json, settings.software_version);
  }
  if (!done) return tl::unexpected(done.error());
  return database.last_insert_id();
}

Result<void> add_drifts(const Database& database, std::int64_t analysis,
                        std::span<const DwellDriftInsert> drifts) {
  auto insert = database.prepare(
      "INSERT INTO dwell_drift (analysis_id, dwell_id, axis, raw_mean_dps, raw_sd_dps, "
      "filtered_mean_dps, filtered_sd_dps, standard_error_dps) VALUES (?, ?, ?, ?, ?, ?, ?, ?)");
  if (!insert) return tl::unexpected(insert.error());
  for (const DwellDriftInsert& drift : drifts) {
    auto done = insert->run(analysis, key(drift.dwell), name_of(drift.axis), drift.raw_mean_dps,
                            drift.raw_sd_dps, drift.filtered_mean_dps, drift.filtered_sd_dps,
                            drift.standard_error_dps);
    if (!done) return done;
  }
  return {};
}

/// The statements of a model's rows, prepared once for all models.
struct ModelStatements {
  Statement model;
  Statement dwell;
  Statement point;
};

Result<ModelStatements> prepare_model_statements(const Database& database) {
  auto model = database.prepare(
      "INSERT INTO model (analysis_id, board_id, axis, method, parameters_json, rmse_dps, "
      "rmse_n_minus_1_dps, mae_dps, max_dps, loocv_rmse_dps, block_rmse_dps, effective_parameters, "
      "recommended, reason, warnings, dwells_sha256) "
      "VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)");
  if (!model) return tl::unexpected(model.error());
  auto dwell =
      database.prepare("INSERT INTO model_dwell (model_id, position, dwell_id) VALUES (?, ?, ?)");
  if (!dwell) return tl::unexpected(dwell.error());
  auto point = database.prepare(
      "INSERT INTO model_point (model_id, position, temperature_c, measured_dps, fitted_dps, "
      "band_dps) VALUES (?, ?, ?, ?, ?, ?)");
  if (!point) return tl::unexpected(point.error());
  return ModelStatements{std::move(*model), std::move(*dwell), std::move(*point)};
}

Result<void> add_model_rows(ModelStatements& statements, std::int64_t model,
                            const ModelInsert& from) {
  for (std::size_t i = 0; i < from.dwells.size(); ++i) {
    auto done = statements.dwell.run(model, static_cast<std::int64_t>(i), key(from.dwells[i]));
    if (!done) return done;
  }
  for (std::size_t i = 0; i < from.points.size(); ++i) {
    const ModelPoint& at = from.points[i];
    auto done = statements.point.run(model, static_cast<std::int64_t>(i), at.temperature_c,
                                     at.measured_dps, at.fitted_dps, at.band_dps);
    if (!done) return done;
  }
  return {};
}

Result<void> add_models(const Database& database, std::int64_t analysis,
                        std::span<const ModelInsert> models) {
  auto statements = prepare_model_statements(database);
  if (!statements) return tl::unexpected(statements.error());
  for (const ModelInsert& model : models) {
    auto done = statements->model.run(
        analysis, key(model.board), name_of(model.axis), model.method, model.parameters_json,
        model.rmse_dps, model.rmse_n_minus_1_dps, model.mae_dps, model.max_dps,
        model.loocv_rmse_dps, model.block_rmse_dps, model.effective_parameters, model.recommended,
        model.reason, model.warnings, model.dwells_sha256);
    if (done) done = add_model_rows(*statements, database.last_insert_id(), model);
    if (!done) return done;
  }
  return {};
}

}  // namespace

Result<void> Store::add_analysis(CampaignId campaign, const AnalysisSettings& settings,
                                 std::span<const DwellDriftInsert> drifts,
                                 std::span<const ModelInsert> models) {
  return impl_->write(fmt::format("the analysis of campaign {}", key(campaign)),
                      [&]() -> Result<void> {
                        const auto id = renew_analysis(impl_->database, campaign, settings);
                        if (!id) return tl::unexpected(id.error());
                        auto done = add_drifts(impl_->database, *id, drifts);
                        if (done) done = add_models(impl_->database, *id, models);
                        return done;
                      });
}

}  // namespace gyrocal
