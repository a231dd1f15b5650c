#pragma once

#include <string>

#include "compensation/values/error.h"
#include "compensation/values/records.h"
#include "schema/store.h"

namespace gyrocal {

/// What a session directory does not say of itself.
struct ImportNames {
  std::string campaign;          ///< name of the campaign it becomes
  std::string source;            ///< where it came from, for messages and board.device
  std::string software_version;  ///< of gyrocal
};

/// Stores a session as a finished campaign of one board and axis, so that everything that reads
/// the database reads it too. Rates become counts again by lsb_dps; the board's temperature is kept
/// to 1/256 K, times to 1 ns. A sample without a rate is stored as a lost one. The accelerometer
/// and the chamber temperature of single samples have no place in the database. An import that
/// breaks off leaves a campaign in state aborted.
/// @return bad_input for rates that are no whole counts of lsb_dps (filtered or rescaled data) or
///   a dwell without a setpoint; nothing is stored then. The errors of Store else.
[[nodiscard]] Result<CampaignId> import_session(Store& store, const Session& session,
                                                const ImportNames& names);

}  // namespace gyrocal
