#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace gyrocal {

/// What an export holds is read back from its text before it is written. These find it.

/// The text between the first `begin` after `after` and the next `end`; empty when not there.
[[nodiscard]] std::string_view text_between(std::string_view text, std::string_view begin,
                                            std::string_view end);

/// A comma-separated list of single-precision numbers; an "f" after a number, blanks and line ends
/// are skipped. Nothing when a field is no number.
[[nodiscard]] std::optional<std::vector<float>> float_list(std::string_view text);
[[nodiscard]] std::optional<float> float_of(std::string_view text);

/// Lines without their ends.
[[nodiscard]] std::vector<std::string_view> lines_of(std::string_view text);
/// Of the first line with `fields` fields of which number `at` is `name`: the number in the field
/// behind it. Nothing where there is no such line, or no number.
[[nodiscard]] std::optional<float> float_beside(std::string_view text, std::string_view name,
                                                char separator, std::size_t fields, std::size_t at);
/// Fields at `separator`, blanks around them taken off.
[[nodiscard]] std::vector<std::string_view> split(std::string_view text, char separator);

}  // namespace gyrocal
