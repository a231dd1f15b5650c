#pragma once

#include <string>

#include "daemon/status/view.h"

namespace gyrocal::notify {

/// Something an absent person wants to know.
struct Notice {
  std::string kind;      ///< "trip" "outage" "outage_over" "failing" "behind" "silent" "ended"
  std::string severity;  ///< "info" "warning" "error"
  std::string sentence;
  std::string advice;
  bool operator==(const Notice&) const = default;
};

/// What a hook gets on its standard input: {"format":"gyrocal-notice/1","kind","severity",
/// "campaign","host","sentence","advice","withheld","status":{...}}; status is what /api/status
/// answers.
/// @param withheld  messages that the rate limit has kept back since the last one.
[[nodiscard]] std::string notice_json(const Notice& notice, const status::View& view,
                                      const std::string& host, int withheld);

/// "weekend: trip: The campaign has tripped: ...": the subject of a mail.
[[nodiscard]] std::string subject(const Notice& notice, const std::string& campaign);

}  // namespace gyrocal::notify
