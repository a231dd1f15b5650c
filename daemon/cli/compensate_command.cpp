#include <fmt/core.h>

#include <algorithm>
#include <memory>

#include "compensation/drift/curve.h"
#include "compensation/drift/left_over.h"
#include "config/drift_model/model_file.h"
#include "daemon/cli/command.h"
#include "daemon/cli/csv_columns.h"
#include "daemon/cli/outcome.h"
#include "daemon/cli/stored_drift.h"

namespace gyrocal::cli {
namespace {

struct CompensateOptions {
  std::string model;
  std::string database;
  std::string method;
  std::string input = "-";
  std::string temperature_column;
  std::string rate_column;
  SensorIdentity sensor;
  bool extrapolate = false;
  bool as_json = false;
};

struct Stream {
  CsvText csv;
  std::size_t temperature_column = 0;
  std::vector<double> temperature_c;
  std::vector<double> rate_dps;
};

struct Compensated {
  std::vector<double> drift_dps;
  std::vector<double> rate_dps;  ///< what is left
};

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

/// What is compensated, and with what.
struct Job {
  Stream stream;
  ModelOfSensor model;
};

Result<ModelOfSensor> model_from_file(const CompensateOptions& options) {
  const auto text = read_text(options.model);
  if (!text) return tl::unexpected(text.error());
  return model_from_text(*text, options.model, options.method);
}

Result<Job> job_from_csv(const CompensateOptions& options) {
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
  return Job{std::move(*stream), std::move(*model)};
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

Result<Job> job_from_database(const CompensateOptions& options) {
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
  return Job{stream_of(measured->table, options.database), std::move(*model)};
}

Result<Compensated> compensated(const Stream& stream, const FittedModel& model,
                                Extrapolation outside) {
  const auto curve = curve_of(model.method, model.parameters);
  if (!curve) return tl::unexpected(curve.error());
  Compensated result;
  for (std::size_t i = 0; i < stream.rate_dps.size(); ++i) {
    const auto drift = evaluate(*curve, {stream.temperature_c[i]}, outside);
    if (!drift) {
      Error error = drift.error();
      error.what =
          fmt::format("{}: {}", stream.csv.place(i, stream.temperature_column), error.what);
      error.advice = "leave the row out, or give --extrapolate";
      return tl::unexpected(std::move(error));
    }
    result.drift_dps.push_back(*drift);
    result.rate_dps.push_back(stream.rate_dps[i] - *drift);
  }
  return result;
}

std::string training_sentence(const FittedModel& model, std::size_t rows, std::size_t all) {
  if (rows == 0) return {};
  return fmt::format(
      "{} of {} rows are data this model was fitted to: what is left there is its training error. "
      "On setpoints it has not seen its error is {:.4f} deg/s RMS.",
      rows, all, model.loocv_rmse_dps);
}

nlohmann::ordered_json to_json(const LeftOver& left) {
  return {{"mean_dps", left.mean_dps},
          {"standard_deviation_dps", left.standard_deviation_dps},
          {"rms_dps", left.rms_dps},
          {"max_dps", left.max_dps}};
}

void print_stream(const Stream& stream, const Compensated& result) {
  std::string text;
  for (const auto& name : stream.csv.header) text += name + ",";
  text += "model_drift_dps,compensated_dps\n";
  for (std::size_t i = 0; i < stream.csv.rows.size(); ++i) {
    for (const auto& field : stream.csv.rows[i]) text += field + ",";
    text += fmt::format("{:.9g},{:.9g}\n", result.drift_dps[i], result.rate_dps[i]);
  }
  fmt::print("{}", text);
}

void print_line(const char* name, const LeftOver& left) {
  fmt::print(stderr, "{:<7}{:>10.4f}{:>10.4f}{:>10.4f}{:>10.4f}\n", name, left.mean_dps,
             left.standard_deviation_dps, left.rms_dps, left.max_dps);
}

int compensate(const CompensateOptions& options) {
  const auto job = options.database.empty() ? job_from_csv(options) : job_from_database(options);
  if (!job) return report(job.error());
  const auto& [stream, given] = *job;
  const auto result = compensated(
      stream, given.model, options.extrapolate ? Extrapolation::allow : Extrapolation::refuse);
  if (!result) return report(result.error());

  const LeftOver before = left_over(stream.rate_dps);
  const LeftOver after = left_over(result->rate_dps);
  const std::size_t training = rows_of_training(given.model, stream.temperature_c, stream.rate_dps);
  const auto sentence = training_sentence(given.model, training, stream.rate_dps.size());
  if (options.as_json) {
    fmt::print("{}\n", nlohmann::ordered_json{{"method", given.model.method},
                                              {"sensor", identity_to_json(given.identity)},
                                              {"rows", stream.rate_dps.size()},
                                              {"rows_of_training", training},
                                              {"before", to_json(before)},
                                              {"after", to_json(after)}}
                           .dump());
  } else {
    print_stream(stream, *result);
    fmt::print(stderr, "{:<7}{:>10}{:>10}{:>10}{:>10}  [deg/s], {} rows, {}\n", "", "mean",
               "std.dev.", "RMS", "max", stream.rate_dps.size(), given.model.method);
    print_line("before", before);
    print_line("after", after);
  }
  if (!sentence.empty()) fmt::print(stderr, "{}\n", sentence);
  return exit_done;
}

}  // namespace

void add_compensate(CLI::App& root, Chosen& chosen) {
  auto* command = root.add_subcommand(
      "compensate",
      "Example: gyrocal compensate --model models.json < log.csv > compensated.csv\n"
      "Takes a model's zero drift off a rate over temperature and reports what is left. The CSV "
      "comes back with two more columns; the report goes to stderr (with --json, only it, to "
      "stdout).");
  const auto options = std::make_shared<CompensateOptions>();
  command->add_option("--model", options->model, "what gyrocal fit --json printed");
  command->add_option(
      "--db", options->database,
      "the zero drifts of the latest campaign instead of a CSV; its own model unless "
      "--model is given");
  command->add_option("--method", options->method, "instead of the recommended one");
  command->add_option("--input", options->input, "CSV file, or - for standard input")
      ->capture_default_str();
  command->add_option("--temperature-column", options->temperature_column,
                      "default: temperature_c, board_c or chamber_c");
  command->add_option("--rate-column", options->rate_column,
                      "default: rate_dps, gyro_z_dps or zero_drift_dps");
  command->add_option("--board", options->sensor.board,
                      "of a database: which; of a file: refuse another one's");
  command->add_option("--axis", options->sensor.axis, "x, y or z, likewise");
  command->add_option("--temperature-scale", options->sensor.temperature_scale,
                      "refuse a model over another thermometer");
  command->add_flag("--extrapolate", options->extrapolate, "beyond the model's setpoints too");
  command->add_flag("--json", options->as_json, "print the report as JSON, no rows");
  command->callback([options, &chosen] { chosen = [options] { return compensate(*options); }; });
}

}  // namespace gyrocal::cli
