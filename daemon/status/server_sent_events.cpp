#include "daemon/status/server_sent_events.h"

#include <fmt/core.h>

#include "daemon/status/numbers.h"
#include "daemon/status/status_json.h"

namespace gyrocal::status {

std::string server_sent_event(std::string_view name, std::string_view data) {
  std::string event = fmt::format("event: {}\ndata: ", name);
  for (const char c : data) {
    if (c == '\r') continue;
    event += c;
    if (c == '\n') event += "data: ";
  }
  return event + "\n\n";
}

std::string server_sent_events(const View& view) {
  return server_sent_event("status", status_json(view)) +
         server_sent_event("numbers", numbers_html(view));
}

}  // namespace gyrocal::status
