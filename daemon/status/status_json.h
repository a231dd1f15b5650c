#pragma once

#include <string>

#include "daemon/status/view.h"

namespace gyrocal::status {

/// What /api/status answers: {"format":"gyrocal-status/1", ...}; docs/status.md names every key. A
/// number that is not known is null.
[[nodiscard]] std::string status_json(const View& view);
/// What /api/events answers: {"format":"gyrocal-events/1","total","events":[...]}, oldest first.
[[nodiscard]] std::string events_json(const View& view);
/// What /api/history answers, for the plots: one array a column, `missing` as null.
[[nodiscard]] std::string history_json(const View& view);

/// "2026-11-24T18:42:21Z"
[[nodiscard]] std::string utc_text(std::int64_t utc_ns);

}  // namespace gyrocal::status
