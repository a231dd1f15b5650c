#pragma once

#include "compensation/values/error.h"
#include "daemon/report/figure.h"

namespace gyrocal::report {

/// The figure as SVG, drawn by the gnuplot program, which is found by the path.
/// @return storage when gnuplot is not installed or fails: the message holds its words.
[[nodiscard]] Result<std::string> svg_of(const Figure& figure);

}  // namespace gyrocal::report
