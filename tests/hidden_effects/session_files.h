#pragma once
#include <filesystem>
#include <string>

#include "tests/hidden_effects/sensor.h"

namespace hidden {

struct SessionHead {
  std::string device;
  std::string axis;
  double monitor_interval_s;
  int samples_per_dwell;
};

/// Writes session.json, monitor.csv and samples.csv (format session-csv/1) into `folder`.
/// @return empty when written, else what went wrong.
std::string write_session(const std::filesystem::path& folder, const SessionHead& head,
                          const Sensor& sensor, const Trajectory& over, const Measured& measured);

/// `text` into `file`, whole. @return empty when written, else what went wrong.
std::string write_file(const std::filesystem::path& file, const std::string& text);

}  // namespace hidden
