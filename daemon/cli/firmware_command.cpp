#include <fmt/core.h>

#include <memory>

#include "compensation/firmware/export.h"
#include "config/drift_model/model_file.h"
#include "daemon/cli/command.h"
#include "daemon/cli/csv_columns.h"
#include "daemon/cli/outcome.h"
#include "daemon/cli/stored_drift.h"
#include "daemon/cli/text_output.h"
#include "gyrocal_version.h"

namespace gyrocal::cli {
namespace {

struct FirmwareOptions {
  std::string format;
  std::vector<std::string> models;
  std::string database;
  std::string method;
  SensorIdentity sensor;
  int instance = 0;
  std::optional<std::uint32_t> device_id;
  std::string output = "-";
};

/// A file needs an axis: where the model does not state one, the command line's, or else z, which
/// is what session files call their gyro column.
void state_axis(SensorIdentity& model, const std::string& asked) {
  if (!model.axis.empty()) return;
  model.axis = asked;
  if (!model.axis.empty()) return;
  model.axis = std::string("z");
  fmt::print(stderr, "warning: the model does not state its axis, z is written; give --axis\n");
}

Result<AxisModel> model_for(const std::string& path, const FirmwareOptions& options) {
  const auto text = read_text(path);
  if (!text) return tl::unexpected(text.error());
  auto given = model_from_text(*text, path, options.method);
  if (!given) return tl::unexpected(std::move(given.error()));
  state_axis(given->identity, options.sensor.axis);
  if (const auto same = check_identity(given->identity, options.sensor); !same) {
    Error error = same.error();
    error.what = fmt::format("{}: {}", path, error.what);
    return tl::unexpected(std::move(error));
  }
  return AxisModel{std::move(given->identity), std::move(given->model)};
}

/// The stored models of one board: of the asked axis, or of every axis it has.
Result<std::vector<AxisModel>> models_from_database(const FirmwareOptions& options) {
  const auto store = Store::open_read_only(options.database);
  if (!store) return tl::unexpected(store.error());
  const auto sensors = sensors_of(*store, options.sensor.board, options.sensor.axis);
  if (!sensors) return tl::unexpected(sensors.error());
  std::vector<AxisModel> axes;
  for (const StoredSensor& sensor : *sensors) {
    if (sensor.id != sensors->front().id) {
      return fail(Errc::bad_input, options.database + " holds several boards, a file is for one",
                  "choose one with --board");
    }
    auto model = stored_model(*store, sensor, options.method);
    if (!model) return tl::unexpected(std::move(model.error()));
    const SensorIdentity scale{{}, {}, options.sensor.temperature_scale};
    if (auto same = check_identity(model->identity, scale); !same) {
      same.error().advice = "fit over that thermometer: gyrocal fit --db ... --temperature-scale";
      return tl::unexpected(std::move(same.error()));
    }
    axes.push_back({std::move(model->identity), std::move(model->model)});
  }
  return axes;
}

Result<std::vector<AxisModel>> models_from_files(const FirmwareOptions& options) {
  std::vector<AxisModel> axes;
  for (const auto& path : options.models) {
    auto model = model_for(path, options);
    if (!model) return tl::unexpected(std::move(model.error()));
    axes.push_back(std::move(*model));
  }
  return axes;
}

Result<FirmwareRequest> request_of(const FirmwareOptions& options) {
  const auto format = firmware_format_named(options.format);
  if (!format) return tl::unexpected(format.error());
  FirmwareRequest request;
  request.format = *format;
  request.instance = options.instance;
  request.device_id = options.device_id;
  request.software_version = GYROCAL_VERSION;
  if (options.models.empty() == options.database.empty()) {
    return fail(Errc::bad_input, "give either --model or --db", "see gyrocal firmware --help");
  }
  auto axes = options.database.empty() ? models_from_files(options) : models_from_database(options);
  if (!axes) return tl::unexpected(std::move(axes.error()));
  request.axes = std::move(*axes);
  return request;
}

Result<void> write_text(const std::string& path, const std::string& text) {
  if (path == "-") {
    fmt::print("{}", text);
    return {};
  }
  return write_text_file(path, text);
}

int write_firmware(const FirmwareOptions& options) {
  const auto request = request_of(options);
  if (!request) return report(request.error());
  const auto file = export_firmware(*request);
  if (!file) return report(file.error());
  if (const auto written = write_text(options.output, file->text); !written) {
    return report(written.error());
  }
  for (const auto& loss : file->losses) {
    fmt::print(stderr,
               "axis {}: read back and evaluated in single precision; against the model at most "
               "{:.2e} deg/s (RMS {:.2e}) by its form and {:.2e} by single precision\n",
               loss.axis, loss.form_max_dps, loss.form_rms_dps, loss.float_max_dps);
  }
  for (const auto& warning : file->warnings) fmt::print(stderr, "warning: {}\n", warning);
  return exit_done;
}

}  // namespace

void add_firmware(Command& root, Chosen& chosen) {
  auto* command = root.add_subcommand(
      "firmware",
      "Example: gyrocal firmware --format c --model models.json --axis z > gyro_zero_drift.h\n"
      "Writes a model for use on a board: c (a C99 header), px4 (TC_G*), ardupilot (INS_TCAL*), "
      "csv or json. The text is read back and evaluated in single precision before it is written.");
  const auto options = std::make_shared<FirmwareOptions>();
  command->add_option("--format", options->format, "c, px4, ardupilot, csv or json")->required();
  command->add_option("--model", options->models,
                      "what gyrocal fit --json printed; one file for each axis");
  command->add_option("--db", options->database,
                      "the stored models of a board of the latest campaign");
  command->add_option("--method", options->method, "instead of the recommended one");
  command->add_option("--board", options->sensor.board,
                      "of a database: which; of a file: refuse another one's");
  command->add_option("--axis", options->sensor.axis,
                      "x, y or z: likewise; or what the model does not say");
  command->add_option("--temperature-scale", options->sensor.temperature_scale,
                      "refuse a model over another thermometer");
  command->add_option("--instance", options->instance, "of the gyro in PX4 or ArduPilot, from 0")
      ->capture_default_str();
  command->add_option("--device-id", options->device_id, "PX4's id of the gyro (TC_G0_ID)");
  command->add_option("-o,--output", options->output, "file, or - for standard output")
      ->capture_default_str();
  command->callback(
      [options, &chosen] { chosen = [options] { return write_firmware(*options); }; });
}

}  // namespace gyrocal::cli
