#pragma once

#include <string>

#include "daemon/status/view.h"

namespace gyrocal::status {

/// The view in Prometheus' text format 0.0.4. Names carry their unit, counters end in _total; what
/// is not known is left out.
[[nodiscard]] std::string metrics_text(const View& view);

}  // namespace gyrocal::status
