#pragma once

#include <string>
#include <string_view>

#include "daemon/status/view.h"

namespace gyrocal::status {

/// One event of the stream: its name, and its data with "data: " before each line. A carriage
/// return would end a line there too and is left out.
[[nodiscard]] std::string server_sent_event(std::string_view name, std::string_view data);

/// What the stream sends of a view: its status and its numbers.
[[nodiscard]] std::string server_sent_events(const View& view);

}  // namespace gyrocal::status
