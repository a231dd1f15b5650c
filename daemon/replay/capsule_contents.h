#pragma once

#include <optional>
#include <string>

#include "compensation/values/error.h"
#include "drivers/recording/recording_database.h"

namespace gyrocal::replay {

/// Puts the database at `path` into a recording, which becomes a capsule: one file that holds all
/// a replay needs. `note` says for people what was cut out, by which gyrocal.
[[nodiscard]] Result<void> put_contents(RecordingDatabase& recording, const std::string& path,
                                        const std::string& note);

/// Writes the database inside a capsule to `path`.
/// @return the note; nothing for a plain recording; storage, bad_frame.
[[nodiscard]] Result<std::optional<std::string>> take_contents(RecordingDatabase& recording,
                                                               const std::string& path);

}  // namespace gyrocal::replay
