#pragma once

#include <string>
#include <vector>

#include "daemon/cli/csv_columns.h"
#include "daemon/cli/stored_drift.h"

namespace gyrocal::cli {

struct CompensateOptions {
  std::string model;
  std::string database;
  bool samples = false;  ///< of a database: its raw samples, not its zero drifts
  std::string method;
  std::string input = "-";
  std::string temperature_column;
  std::string rate_column;
  SensorIdentity sensor;
  bool extrapolate = false;
  bool as_json = false;
};

/// Rows of a CSV file, or of a database written as one.
struct Stream {
  CsvText csv;
  std::size_t temperature_column = 0;
  std::vector<double> temperature_c;
  std::vector<double> rate_dps;
};

/// What is compensated, and with what.
struct CompensationJob {
  Stream stream;
  ModelOfSensor model;
  std::size_t training;  ///< of `measured`: data the model was fitted to
  std::size_t measured;  ///< rows, or the setpoints the samples were taken at
  const char* measured_name;
};

[[nodiscard]] Result<CompensationJob> compensation_job(const CompensateOptions& options);

}  // namespace gyrocal::cli
