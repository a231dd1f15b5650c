#include <fmt/core.h>

#include <algorithm>
#include <memory>

#include "compensation/drift/curve.h"
#include "compensation/drift/left_over.h"
#include "daemon/cli/command.h"
#include "daemon/cli/compensation_job.h"
#include "daemon/cli/outcome.h"

namespace gyrocal::cli {
namespace {

struct Compensated {
  std::vector<double> drift_dps;
  std::vector<double> rate_dps;  ///< what is left
};

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

std::string training_sentence(const CompensationJob& job) {
  if (job.training == 0) return {};
  return fmt::format(
      "{} of {} {} are data this model was fitted to: what is left there is its training error. "
      "On setpoints it has not seen its error is {:.4f} deg/s RMS.",
      job.training, job.measured, job.measured_name, job.model.model.loocv_rmse_dps);
}

nlohmann::ordered_json left_over_json(const LeftOver& left) {
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
  const auto job = compensation_job(options);
  if (!job) return report(job.error());
  const Stream& stream = job->stream;
  const ModelOfSensor& given = job->model;
  const auto result = compensated(
      stream, given.model, options.extrapolate ? Extrapolation::allow : Extrapolation::refuse);
  if (!result) return report(result.error());

  const LeftOver before = left_over(stream.rate_dps);
  const LeftOver after = left_over(result->rate_dps);
  const auto sentence = training_sentence(*job);
  if (options.as_json) {
    fmt::print("{}\n", nlohmann::ordered_json{{"method", given.model.method},
                                              {"sensor", identity_to_json(given.identity)},
                                              {"rows", stream.rate_dps.size()},
                                              {job->measured_name + std::string("_of_training"),
                                               job->training},
                                              {"before", left_over_json(before)},
                                              {"after", left_over_json(after)}}
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

void add_compensate(Command& root, Chosen& chosen) {
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
  command->add_flag("--samples", options->samples,
                    "of a database: its raw samples, every one, instead of the zero drifts");
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
