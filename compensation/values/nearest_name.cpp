#include "compensation/values/nearest_name.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <vector>

namespace gyrocal {
namespace {

/// Optimal string alignment distance: Levenshtein plus swaps of neighbours, the usual typo.
std::size_t edits(std::string_view a, std::string_view b) {
  std::vector<std::vector<std::size_t>> d(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) d[i][0] = i;
  for (std::size_t j = 0; j <= b.size(); ++j) d[0][j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = d[i - 1][j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      d[i][j] = std::min({d[i - 1][j] + 1, d[i][j - 1] + 1, replaced});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
        d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
      }
    }
  }
  return d[a.size()][b.size()];
}

}  // namespace

std::string nearest_name(std::string_view asked, std::span<const std::string_view> known) {
  constexpr std::size_t longest = 64;  // the table is quadratic; nobody mistypes more than that
  if (asked.size() > longest) return {};
  std::string best;
  std::size_t best_edits = longest;
  for (const std::string_view name : known) {
    const std::size_t n = edits(asked, name);
    if (n * 3 <= std::max(asked.size(), name.size()) && n < best_edits) {
      best = name;
      best_edits = n;
    }
  }
  return best;
}

std::string is_meant(std::string_view asked, std::span<const std::string_view> known) {
  const auto near = nearest_name(asked, known);
  return near.empty() ? near : "is \"" + near + "\" meant? ";
}

std::string known_names(std::string_view what, std::string_view asked,
                        std::span<const std::string_view> known) {
  const auto near = nearest_name(asked, known);
  return fmt::format("known {}: {}{}", what, fmt::join(known, " "),
                     near.empty() ? "" : fmt::format("; is {} meant?", near));
}

}  // namespace gyrocal
