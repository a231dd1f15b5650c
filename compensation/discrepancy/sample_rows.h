#pragma once

#include <cstddef>
#include <optional>

#include "compensation/values/records.h"

namespace gyrocal {

/// The slow stream tells nothing below so many rows with a gyro mean.
inline constexpr std::size_t monitor_rows_min = 32;

[[nodiscard]] std::size_t rows_with_gyro(const Session& session);

/// The session with a monitor made of its dwells' samples: means over a second, over less where
/// that makes too few, over four samples at least. For a record that holds samples and next to no
/// slow stream: what happened between its dwells is lost. Across a pause the temperature is taken
/// to have reached the next dwell's half way.
[[nodiscard]] Session with_rows_of_samples(const Session& session);

/// What is judged in place of a session with next to no slow stream; nothing where it is judged as
/// it was recorded.
[[nodiscard]] std::optional<Session> stand_in_for(const Session& recorded);

}  // namespace gyrocal
