#pragma once

#include <string>
#include <string_view>

namespace gyrocal {

/// The 1-based line on which the value at a JSON pointer ("/effects/0/law") begins, or that of its
/// nearest parent that exists. `text` must be valid JSON.
[[nodiscard]] int json_line(std::string_view text, std::string_view pointer);

}  // namespace gyrocal
