#pragma once

#include <string>

#include "compensation/values/error.h"
#include "compensation/values/records.h"

namespace gyrocal {

/// session.json as a session without rows. `source` names the file in messages.
/// @return bad_input with line and column (no JSON) or the key, what stands there, what was
/// expected.
[[nodiscard]] Result<Session> parse_session_json(const std::string& text,
                                                 const std::string& source);

[[nodiscard]] std::string to_session_json(const Session& session);

}  // namespace gyrocal
