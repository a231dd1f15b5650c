#include "daemon/cli/stored_drift.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "compensation/drift/setpoint_means.h"
#include "daemon/cli/one_of.h"

namespace gyrocal::cli {
namespace {

std::string title(const StoredSensor& sensor) {
  return fmt::format("board '{}', axis {}", sensor.board.name, letter(sensor.axis));
}

/// Means over each setpoint of what was measured in its dwells, in the order of the setpoints.
Result<std::vector<double>> means_of(const std::vector<double>& setpoint_c,
                                     const std::vector<double>& values) {
  auto means = setpoint_means({setpoint_c, values});
  if (!means) return tl::unexpected(std::move(means.error()));
  return std::move(means->table.zero_drift_dps);
}

FittedModel model_of(const ModelInsert& stored, std::vector<NamedParameter> parameters) {
  FittedModel model;
  model.method = stored.method;
  model.parameters = std::move(parameters);
  for (const ModelPoint& point : stored.points) {
    model.setpoint_c.push_back(point.temperature_c);
    model.measured_dps.push_back(point.measured_dps);
    model.fitted_dps.push_back(point.fitted_dps);
    model.band_dps.push_back(point.band_dps);
  }
  model.training = {stored.rmse_dps, stored.rmse_n_minus_1_dps, stored.mae_dps, stored.max_dps};
  model.loocv_rmse_dps = stored.loocv_rmse_dps;
  model.block_rmse_dps = stored.block_rmse_dps;
  model.effective_parameters = stored.effective_parameters;
  return model;
}

}  // namespace

double temperature_of(const AcceptedDwell& dwell, const std::string& scale) {
  if (scale == "chamber") return dwell.chamber_mean_c;
  if (scale == "board") return dwell.board_mean_c;
  return dwell.setpoint.value;
}

SensorIdentity identity_of(const StoredSensor& sensor, const std::string& temperature_scale) {
  return {sensor.board.mcu_id.empty() ? sensor.board.name : sensor.board.mcu_id,
          std::string(1, letter(sensor.axis)), temperature_scale};
}

Result<std::vector<StoredSensor>> sensors_of(const Store& store, const std::string& board,
                                             const std::string& axis) {
  const auto campaign = store.latest_campaign();
  if (!campaign) return tl::unexpected(campaign.error());
  if (!*campaign) {
    return fail(Errc::bad_input, "the database holds no campaign", "run one, or import a session");
  }
  auto boards = store.boards(**campaign);
  if (!boards) return tl::unexpected(std::move(boards.error()));
  std::vector<StoredSensor> sensors;
  std::vector<std::string> known;
  for (const auto& [id, row] : *boards) {
    known.push_back(row.name);
    if (!board.empty() && board != row.name && board != row.mcu_id) continue;
    for (const Axis a : all_axes) {
      if (!row.measured[static_cast<std::size_t>(a)]) continue;
      if (axis.empty() || axis == std::string(1, letter(a))) {
        sensors.push_back({**campaign, id, row, a});
      }
    }
  }
  if (!sensors.empty()) return sensors;
  return fail(
      Errc::unknown_name,
      fmt::format("no board \"{}\" with data of axis \"{}\" in the latest campaign", board, axis),
      one_of(board, "boards", known) + "; axes: x, y, z");
}

Result<MeasuredTable> stored_table(const Store& store, const StoredSensor& sensor,
                                   const std::string& temperature_scale) {
  if (temperature_scale != "setpoint" && temperature_scale != "chamber" &&
      temperature_scale != "board") {
    return fail(Errc::unknown_name,
                fmt::format("no temperature scale is named \"{}\"", temperature_scale),
                one_of(temperature_scale, "a database knows", {"setpoint", "chamber", "board"}));
  }
  const auto dwells = store.accepted_dwells(sensor.campaign, sensor.id);
  if (!dwells) return tl::unexpected(dwells.error());
  const auto drifts = store.drifts(sensor.campaign, sensor.id, sensor.axis);
  if (!drifts) return tl::unexpected(drifts.error());
  if (drifts->empty()) {
    return fail(Errc::bad_input, title(sensor) + ": the campaign has not been analysed",
                "let it finish");
  }
  std::map<DwellId, AcceptedDwell> dwell_of;
  for (const AcceptedDwell& dwell : *dwells) dwell_of.emplace(dwell.id, dwell);
  std::vector<double> setpoint_c, temperature_c, drift_dps, error_dps;
  for (const DwellDriftInsert& drift : *drifts) {
    const auto dwell = dwell_of.find(drift.dwell);
    if (dwell == dwell_of.end()) continue;  // rejected since it was analysed
    const double temperature = temperature_of(dwell->second, temperature_scale);
    if (std::isnan(temperature)) {
      return fail(Errc::bad_input,
                  fmt::format("{}: the dwell at {} degC has no {} temperature", title(sensor),
                              dwell->second.setpoint.value, temperature_scale),
                  "take --temperature-scale setpoint");
    }
    setpoint_c.push_back(dwell->second.setpoint.value);
    temperature_c.push_back(temperature);
    drift_dps.push_back(drift.filtered_mean_dps);
    error_dps.push_back(drift.standard_error_dps);
  }
  const bool errors_known =
      std::all_of(error_dps.begin(), error_dps.end(), [](double e) { return e > 0; });
  if (!errors_known) error_dps.clear();
  auto means = setpoint_means({setpoint_c, drift_dps}, error_dps);
  if (!means) return tl::unexpected(std::move(means.error()));
  auto temperatures = means_of(setpoint_c, temperature_c);
  if (!temperatures) return tl::unexpected(std::move(temperatures.error()));
  return MeasuredTable{{std::move(*temperatures), std::move(means->table.zero_drift_dps)},
                       std::move(means->standard_error_dps)};
}

Result<ModelOfSensor> stored_model(const Store& store, const StoredSensor& sensor,
                                   const std::string& method) {
  const auto models = store.models(sensor.campaign, sensor.id, sensor.axis);
  if (!models) return tl::unexpected(models.error());
  std::vector<std::string> known;
  for (const ModelInsert& stored : *models) {
    known.push_back(stored.method);
    if (method.empty() ? !stored.recommended : stored.method != method) continue;
    const auto json = nlohmann::ordered_json::parse(stored.parameters_json, nullptr, false);
    auto parameters = parameters_from_json(json);
    if (!parameters) return tl::unexpected(std::move(parameters.error()));
    return ModelOfSensor{identity_of(sensor), model_of(stored, std::move(*parameters))};
  }
  if (known.empty()) {
    return fail(Errc::bad_input, title(sensor) + ": no model is stored", "let the campaign finish");
  }
  return fail(Errc::unknown_name,
              method.empty() ? title(sensor) + ": no stored model is recommended"
                             : fmt::format("{}: no model \"{}\" is stored", title(sensor), method),
              one_of(method, "choose one of", known));
}

}  // namespace gyrocal::cli
