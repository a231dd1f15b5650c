#pragma once

#include "tests/bench/row.h"

/// The sections of the table: each measures and returns its rows.
namespace gyrocal::bench {

[[nodiscard]] Rows wavelet_rows();      ///< beside PyWavelets and GSL
[[nodiscard]] Rows fit_rows();          ///< beside NumPy
[[nodiscard]] Rows analysis_rows();     ///< SQLite to stored models, beside a Python script
[[nodiscard]] Rows store_rows();        ///< samples to disk, beside bare statements
[[nodiscard]] Rows codec_rows();        ///< bytes to samples
[[nodiscard]] Rows acquisition_rows();  ///< 64 boards on pseudo-terminals
[[nodiscard]] Rows modbus_rows();       ///< round trips, beside libmodbus and pymodbus
[[nodiscard]] Rows campaign_rows();     ///< virtual time, replay
[[nodiscard]] Rows query_rows();        ///< docs/queries.md on 7.5 million samples
[[nodiscard]] Rows diagnose_rows();     ///< sessions with something hidden in them
[[nodiscard]] Rows start_rows();        ///< how long a program takes to begin

}  // namespace gyrocal::bench
