#pragma once

#include <string>
#include <vector>

#include "compensation/drift/identity.h"
#include "config/drift_model/model_file.h"
#include "daemon/cli/drift_table_csv.h"
#include "schema/store.h"

namespace gyrocal::cli {

/// One axis of one board of a database's latest campaign.
struct StoredSensor {
  CampaignId campaign{};
  BoardId id{};
  BoardRow board;
  Axis axis = Axis::z;
};

/// Board by MCU id, or by name where it sent none. Stored models stand over the setpoints.
[[nodiscard]] SensorIdentity identity_of(const StoredSensor& sensor,
                                         const std::string& temperature_scale = "setpoint");

/// The axes with data of the boards of the latest campaign.
/// @param board  name or MCU id; empty: all.
/// @param axis   "x", "y" or "z"; empty: all.
/// @return unknown_name with the names there are; bad_input when there is no campaign; what the
///         store returns.
[[nodiscard]] Result<std::vector<StoredSensor>> sensors_of(const Store& store,
                                                           const std::string& board,
                                                           const std::string& axis);

/// A dwell's temperature on a scale that stored_table() knows; missing where it was not measured.
[[nodiscard]] double temperature_of(const AcceptedDwell& dwell, const std::string& scale);

/// Filtered zero drifts, one row a setpoint, over the setpoints or over the chamber's or the
/// board's own mean temperature in the dwells.
/// @param temperature_scale  "setpoint", "chamber" or "board".
/// @return bad_input when the campaign has not been analysed or a dwell has no such temperature;
///         unknown_name for another scale.
[[nodiscard]] Result<MeasuredTable> stored_table(const Store& store, const StoredSensor& sensor,
                                                 const std::string& temperature_scale);

/// @param method  empty: the recommended one.
/// @return unknown_name with the methods that are stored.
[[nodiscard]] Result<ModelOfSensor> stored_model(const Store& store, const StoredSensor& sensor,
                                                 const std::string& method);

}  // namespace gyrocal::cli
