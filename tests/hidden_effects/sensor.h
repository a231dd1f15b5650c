#pragma once
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "tests/hidden_effects/random.h"
#include "tests/hidden_effects/thermal.h"

namespace hidden {

struct Vibration {
  double line_dps;  ///< amplitude of the rotor's line while the compressor runs
  double step_dps;  ///< rectified: added to the bias while it runs
  double rotor_hz;  ///< at no load; slips with load
  double shake_g;   ///< the same line in the accelerometer
};
struct Hum {
  double line_dps;
  double grid_hz;
  double second_harmonic;  ///< share of line_dps at twice the grid
};
/// Two levels, zero and height; leaves either after an exponential time, both shortened as the
/// die warms.
struct Telegraph {
  double height_dps;
  double low_s, high_s;  ///< mean stay at 20 degC
  double warming_per_c;  ///< rates grow by exp(this (T - 20))
};
struct Glitches {
  double probability;
  double size_dps;  ///< smallest; the largest is four times that
};
struct Sticking {
  double runs_per_sample;
  double mean_length;
};
/// Bursts of loss: the link is good, then bad for a while and loses most of what passes.
struct Loss {
  double bursts_per_sample;
  double mean_burst;
};

/// The sensor and its link, all but what the slow bias does.
struct Sensor {
  double rate_hz = 50.0;     ///< as the session says
  double clock_error = 0.0;  ///< true rate = rate_hz (1 + this)
  double white_dps = 0.1;
  double lsb_dps = 0.05;
  double white_per_c = 0.0;  ///< sigma grows by exp(this (T - 20))
  double white_per_h = 0.0;  ///< sigma grows by exp(this t): not of the catalogue
  std::optional<Vibration> vibration;
  std::optional<Hum> hum;
  std::optional<Telegraph> telegraph;
  std::optional<Glitches> glitches;
  std::optional<Sticking> sticking;
  std::optional<Loss> loss;
  std::optional<std::pair<double, double>> rails_dps;
  double missing_share = 0.0;     ///< of all codes, scattered; these are never put out
  std::uint64_t missing_key = 0;  ///< which ones
  double board_offset_c = 0.0;
  double board_gain = 0.0;
  double board_step_c = 0.125;  ///< resolution of the board's thermometer
  double air_step_c = 0.01;
  bool has_acceleration = true;
  bool has_air = true;
};

struct MonitorRow {
  double t_s, setpoint_c, air_c, board_c, gyro_dps;
  bool gyro_known;
};
struct SampleRow {
  int dwell;
  std::int64_t seq;
  double t_s, gyro_dps, acc_x_g, acc_y_g, acc_z_g, board_c, air_c;
};
/// What was really done where chance decided, in samples.
struct Tally {
  double all = 0.0, displaced = 0.0, glitched = 0.0, stuck = 0.0, lost = 0.0, at_rail = 0.0;
};
struct Measured {
  std::vector<double> dwell_start_s;
  std::vector<MonitorRow> monitor;
  std::vector<SampleRow> samples;
  Tally in_dwells;
};

/// Share of samples about `center_dps` whose code is one of the missing.
double share_displaced(const Sensor& sensor, double center_dps);

/// Of the codes between two rates, how many are missing.
double share_of_codes_missing(const Sensor& sensor, double low_dps, double high_dps);

/// Runs the sensor at its full rate through the whole campaign; monitor rows are means of exactly
/// the samples that arrived.
/// @param bias_dps  slow bias once a second, between which it moves linearly.
/// @param tilt_rad  tilt of the board about x once a second; empty = level and still.
Measured measure(const Sensor& sensor, const Trajectory& over, const std::vector<double>& bias_dps,
                 const std::vector<double>& tilt_rad, int samples_per_dwell,
                 double monitor_interval_s, Random& random);

}  // namespace hidden
