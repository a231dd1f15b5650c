#pragma once

#include <span>
#include <string>
#include <string_view>

namespace gyrocal {

/// The known name a person most likely meant: the one with the fewest edits (insert, delete,
/// replace, swap of neighbours), if at most a third of the longer name has to change.
/// @return empty if nothing is near. O(known * length^2); for messages.
[[nodiscard]] std::string nearest_name(std::string_view asked,
                                       std::span<const std::string_view> known);

/// For the advice of an error: "is \"fit\" meant? ", or empty if nothing is near.
[[nodiscard]] std::string is_meant(std::string_view asked, std::span<const std::string_view> known);

/// The whole advice for a word that is none of a closed set: "known modes: zero constant; is zero
/// meant?".
/// @param what  what the names are of, in the plural.
[[nodiscard]] std::string known_names(std::string_view what, std::string_view asked,
                                      std::span<const std::string_view> known);

}  // namespace gyrocal
