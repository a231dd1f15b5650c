#pragma once

#include <optional>
#include <string>

#include "compensation/values/error.h"
#include "drivers/recording/recording_database.h"

namespace gyrocal::replay {

/// Puts the database at `path` into a recording, which becomes a capsule: one file that holds all
/// a replay needs.
[[nodiscard]] Result<void> put_database(RecordingDatabase& recording, const std::string& path);

/// Writes the database inside a capsule to `path`. @return whether there is one: false for a plain
/// recording; storage, bad_frame.
[[nodiscard]] Result<bool> take_database(RecordingDatabase& recording, const std::string& path);

}  // namespace gyrocal::replay
