#pragma once

#include <optional>
#include <string>

#include "compensation/values/error.h"
#include "compensation/values/records.h"

namespace gyrocal {

/// What no single row of a session shows: dwells outside the record, a sample rate that the times
/// contradict. For a session with rows, in time order; `folder` names it in messages.
[[nodiscard]] std::optional<Error> contradiction_in(const Session& session,
                                                    const std::string& folder);

}  // namespace gyrocal
