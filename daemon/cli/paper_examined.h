#pragma once

namespace gyrocal::cli {

/// `gyrocal paper --examine`: what the paper leaves open or gets wrong, each with its number: the
/// degree of the residual polynomial, the order of the setpoints, errors on left-out setpoints, the
/// noise of a zero drift, the unit of 4.13. docs/paper.md discusses them. Returns the exit code.
int report_paper_examined();

/// `gyrocal paper --table-1`: Table 1 as gyrocal fit --table reads it.
int print_paper_table_1();

}  // namespace gyrocal::cli
