#pragma once

#include <string>

#include "compensation/values/error.h"
#include "compensation/values/records.h"

namespace gyrocal {

/// Reads a session directory, format session-csv/1 (DESIGN section 6): session.json, monitor.csv,
/// samples.csv. Columns stand in any order; optional ones can be absent or empty (`missing`).
/// Dwells and their samples come back in time order, whatever the order of the blocks in the file.
/// @return storage (a file cannot be read); bad_input or not_finite with file, line and column for
///   text that is no number, rows too short, time running backwards, a row twice, samples of a
///   dwell nobody listed, dwells outside the record, another unit, a rate that contradicts the
///   times.
[[nodiscard]] Result<Session> read_session(const std::string& folder);

/// Writes a session directory, making the folder; files of a former session there are replaced,
/// session.json last. Numbers are the shortest that read back to the same bits.
[[nodiscard]] Result<void> write_session(const std::string& folder, const Session& session);

}  // namespace gyrocal
