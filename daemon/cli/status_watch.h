#pragma once

#include <optional>
#include <string>

#include "compensation/values/error.h"

namespace gyrocal::cli {

/// What a running campaign answered to "status", as one line for a person.
/// @param columns  of the terminal: what does not fit is left out from the right, word by word.
/// @param in_colour  the state by colour.
/// @return bad_input if the answer is none.
[[nodiscard]] Result<std::string> status_line(const std::string& answer,
                                              std::optional<std::size_t> columns, bool in_colour);

/// Whether the answer's state is one that nothing follows.
[[nodiscard]] bool answer_has_ended(const std::string& answer);

/// Shows the campaign at `socket` until it ends or Ctrl-C: on a terminal one line that is drawn
/// again each second, elsewhere a line whenever something has changed. Colours only on a terminal
/// and without NO_COLOR. @return an exit code.
[[nodiscard]] int watch_campaign(const std::string& socket, bool as_json);

}  // namespace gyrocal::cli
