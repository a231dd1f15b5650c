#pragma once

#include <string_view>
#include <vector>

#include "compensation/values/error.h"

namespace gyrocal::cli {

/// Numbers separated by blanks, tabs and line ends (LF, CRLF or CR). A byte-order mark at the start
/// is taken.
/// @param source  for messages: the path, or "standard input".
/// @return at least one finite number; bad_input, not_finite or out_of_range (beyond a double)
///         naming source, line, column (from 1, in characters of the line) and what was read there.
[[nodiscard]] Result<std::vector<double>> parse_numbers(std::string_view text,
                                                        std::string_view source);

}  // namespace gyrocal::cli
