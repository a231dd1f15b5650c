#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "compensation/values/units.h"

namespace gyrocal {

/// Stands for "not measured" in bulk columns; test with std::isnan.
inline constexpr double missing = std::numeric_limits<double>::quiet_NaN();

/// One gyro sample as the board sent it.
struct BoardSample {
  std::int64_t t_ns = 0;                 ///< campaign time [ns] at which the board took it (estimated)
  std::uint32_t counter = 0;             ///< unwrapped frame counter since Start, first frame 1
  std::array<std::int16_t, 3> gyro_lsb{};  ///< raw counts, X Y Z
  std::optional<std::int16_t> temperature_raw;  ///< STLM75, degC * 256; absent if not in the frame
  bool operator==(const BoardSample&) const = default;
};

/// Zero drift over setpoints: what the models are fitted to. Equal lengths, in setpoint order.
struct DriftTable {
  std::vector<double> temperature_c;
  std::vector<double> zero_drift_dps;
};

/// One row of the slow stream: means over an interval, t at its centre. `missing` where a column
/// was not recorded.
struct MonitorRow {
  double t_s = 0;  ///< since campaign start
  double setpoint_c = missing;
  double chamber_c = missing;
  double board_c = missing;
  double gyro_dps = missing;
};

/// One full-rate row of a dwell.
struct SessionSample {
  std::int32_t dwell = 0;
  std::int64_t seq = 0;  ///< restarts at 0 in each dwell; a hole is a lost sample
  double t_s = 0;
  double gyro_dps = missing;
  std::array<double, 3> acc_g{missing, missing, missing};
  double board_c = missing;
  double chamber_c = missing;
};

struct SessionDwell {
  std::int32_t dwell = 0;
  double setpoint_c = missing;
  double t_start_s = 0;
};

/// One axis of one board over a whole campaign: a session directory (DESIGN section 6) or a slice
/// of the database, in memory. Rows are in time order.
struct Session {
  std::string device;
  std::string axis;
  double sample_rate_hz = 50;
  double monitor_interval_s = 5;
  double lsb_dps = 1 / 4.13;  ///< size of one ADC count
  int samples_per_dwell = 3000;
  std::vector<SessionDwell> dwells;
  std::vector<MonitorRow> monitor;
  std::vector<SessionSample> samples;
};

}  // namespace gyrocal
