#pragma once

#include <string>

#include "daemon/status/view.h"

namespace gyrocal::status {

/// The numbers of the page as HTML, one <section id=...> after the other: what the page shows
/// without a script, and what a script puts in place of the old ones.
[[nodiscard]] std::string numbers_html(const View& view);

/// The whole page.
[[nodiscard]] std::string page_html(const View& view);

}  // namespace gyrocal::status
