#include "daemon/cli/compensation_job.h"

#include <fmt/core.h>

#include "compensation/drift/left_over.h"
#include "config/drift_model/model_file.h"
#include "daemon/runner/analysis.h"

namespace gyrocal::cli {
namespace {

/// The named column, or the first of the usual names the file has.
Result<std::size_t> column_of(const CsvText& csv, const std::string& named,
                              std::initializer_list<const char*> usual) {
  if (!named.empty()) return column_named(csv, named);
  for (const char* name : usual) {
    if (const auto column = column_named(csv, name)) return *column;
  }
  return column_named(csv, *usual.begin());
}

Result<Stream> read_stream(const CompensateOptions& options) {
  const auto text = read_text(options.input);
  if (!text) return tl::unexpected(text.error());
  auto csv = parse_csv(*text, options.input == "-" ? "standard input" : options.input);
  if (!csv) return tl::unexpected(std::move(csv.error()));
  const auto temperature =
      column_of(*csv, options.temperature_column, {"temperature_c", "board_c", "chamber_c"});
  if (!temperature) return tl::unexpected(temperature.error());
  const auto rate =
      column_of(*csv, options.rate_column, {"rate_dps", "gyro_z_dps", "zero_drift_dps"});
  if (!rate) return tl::unexpected(rate.error());
  auto temperature_c = numbers_of(*csv, *temperature);
  if (!temperature_c) return tl::unexpected(std::move(temperature_c.error()));
  auto rate_dps = numbers_of(*csv, *rate);
  if (!rate_dps) return tl::unexpected(std::move(rate_dps.error()));
  return Stream{std::move(*csv), *temperature, std::move(*temperature_c), std::move(*rate_dps)};
}

Result<ModelOfSensor> model_from_file(const CompensateOptions& options) {
  const auto text = read_text(options.model);
  if (!text) return tl::unexpected(text.error());
  return model_from_text(*text, options.model, options.method);
}

CompensationJob job_of_rows(Stream stream, ModelOfSensor model) {
  const std::size_t training = rows_of_training(model.model, stream.temperature_c, stream.rate_dps);
  const std::size_t rows = stream.rate_dps.size();
  return {std::move(stream), std::move(model), training, rows, "rows"};
}

Result<CompensationJob> job_from_csv(const CompensateOptions& options) {
  if (options.model.empty()) return fail(Errc::bad_input, "give --model, or --db");
  if (options.model == "-" && options.input == "-") {
    return fail(Errc::bad_input, "model and rows cannot both come from standard input",
                "give --input FILE");
  }
  auto model = model_from_file(options);
  if (!model) return tl::unexpected(std::move(model.error()));
  if (auto same = check_identity(model->identity, options.sensor); !same) {
    return tl::unexpected(std::move(same.error()));
  }
  auto stream = read_stream(options);
  if (!stream) return tl::unexpected(std::move(stream.error()));
  return job_of_rows(std::move(*stream), std::move(*model));
}

/// The zero drifts of a stored campaign as rows.
Stream stream_of(const DriftTable& table, const std::string& source) {
  Stream stream{{source, {"temperature_c", "zero_drift_dps"}, {}, {}},
                0,
                table.temperature_c,
                table.zero_drift_dps};
  for (std::size_t i = 0; i < table.temperature_c.size(); ++i) {
    stream.csv.rows.push_back({fmt::format("{:.9g}", table.temperature_c[i]),
                               fmt::format("{:.9g}", table.zero_drift_dps[i])});
    stream.csv.line.push_back(static_cast<int>(i + 1));
  }
  return stream;
}

/// Temperature of one sample on a scale; the board's own where the sample has it.
double sample_temperature(const BoardSample& sample, const AcceptedDwell& dwell,
                          const std::string& scale) {
  if (scale == "board" && sample.temperature_raw) return *sample.temperature_raw / 256.0;
  return temperature_of(dwell, scale);
}

/// Every raw sample of the accepted dwells.
Result<Stream> samples_of(const Store& store, const StoredSensor& sensor, const std::string& scale,
                          const std::string& source) {
  const auto dwells = store.accepted_dwells(sensor.campaign, sensor.id);
  if (!dwells) return tl::unexpected(dwells.error());
  Stream stream{{source, {"t_s", "setpoint_c", "temperature_c", "rate_dps"}, {}, {}}, 2, {}, {}};
  for (const AcceptedDwell& dwell : *dwells) {
    const auto samples = store.samples(dwell.id);
    if (!samples) return tl::unexpected(samples.error());
    const auto rates = runner::rates_dps(*samples, sensor.axis, sensor.board, dwell.board_mean_c);
    for (std::size_t i = 0; i < rates.size(); ++i) {
      const double temperature_c = sample_temperature((*samples)[i], dwell, scale);
      stream.temperature_c.push_back(temperature_c);
      stream.rate_dps.push_back(rates[i]);
      stream.csv.rows.push_back({fmt::format("{:.6f}", 1e-9 * double((*samples)[i].t_ns)),
                                 fmt::format("{:.9g}", dwell.setpoint.value),
                                 fmt::format("{:.9g}", temperature_c),
                                 fmt::format("{:.9g}", rates[i])});
      stream.csv.line.push_back(static_cast<int>(stream.csv.rows.size()));
    }
  }
  return stream;
}

Result<CompensationJob> job_from_database(const CompensateOptions& options) {
  const auto store = Store::open_read_only(options.database);
  if (!store) return tl::unexpected(store.error());
  const auto sensors = sensors_of(*store, options.sensor.board, options.sensor.axis);
  if (!sensors) return tl::unexpected(sensors.error());
  if (sensors->size() > 1) {
    return fail(Errc::bad_input,
                fmt::format("{} holds {} axes of boards", options.database, sensors->size()),
                "choose one with --board and --axis");
  }
  const StoredSensor& sensor = sensors->front();
  auto model = options.model.empty() ? stored_model(*store, sensor, options.method)
                                     : model_from_file(options);
  if (!model) return tl::unexpected(std::move(model.error()));
  const auto& stated = model->identity.temperature_scale;
  const std::string scale = stated.empty() ? "setpoint" : stated;
  // What the model states of itself must be true of the stored sensor.
  if (auto same = check_identity(identity_of(sensor, scale), model->identity); !same) {
    return tl::unexpected(std::move(same.error()));
  }
  const auto measured = stored_table(*store, sensor, scale);
  if (!measured) return tl::unexpected(measured.error());
  if (!options.samples) {
    return job_of_rows(stream_of(measured->table, options.database), std::move(*model));
  }
  auto stream = samples_of(*store, sensor, scale, options.database);
  if (!stream) return tl::unexpected(std::move(stream.error()));
  const std::size_t training =
      rows_of_training(model->model, measured->table.temperature_c, measured->table.zero_drift_dps);
  return CompensationJob{std::move(*stream), std::move(*model), training,
                         measured->table.temperature_c.size(), "setpoints"};
}

}  // namespace

Result<CompensationJob> compensation_job(const CompensateOptions& options) {
  if (!options.database.empty()) return job_from_database(options);
  if (options.samples) return fail(Errc::bad_input, "--samples goes with --db");
  return job_from_csv(options);
}

}  // namespace gyrocal::cli
