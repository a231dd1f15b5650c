#pragma once

#include "compensation/drift/analysis.h"

namespace gyrocal::cli {

/// A table of methods and errors, the recommended one starred, and the reason: to stdout.
void print_analysis(const Analysis& analysis);
/// Warnings and methods that were refused: to stderr.
void print_complaints(const Analysis& analysis);

}  // namespace gyrocal::cli
