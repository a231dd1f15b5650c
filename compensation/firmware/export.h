#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "compensation/drift/identity.h"
#include "compensation/drift/model.h"

namespace gyrocal {

enum class FirmwareFormat { c, px4, ardupilot, csv, json };

/// @return unknown_name, with the list of known ones.
[[nodiscard]] Result<FirmwareFormat> firmware_format_named(std::string_view name);

struct AxisModel {
  SensorIdentity identity;  ///< axis must be stated
  FittedModel model;
};

struct FirmwareRequest {
  FirmwareFormat format = FirmwareFormat::c;
  std::vector<AxisModel> axes;  ///< 1 to 3, one board and one temperature scale
  int instance = 0;             ///< PX4: TC_G0...3; ArduPilot: IMU 1...3 is instance 0...2
  std::optional<std::uint32_t> device_id;  ///< PX4 only
  std::string software_version;
};

/// What an axis lost on its way into the file.
struct ExportLoss {
  std::string axis;
  double form_max_dps = 0;  ///< largest difference of the file's form (rows, cubic) from the model
  double form_rms_dps = 0;
  double float_max_dps = 0;  ///< largest further difference of single precision, from the text
};

struct FirmwareFile {
  std::string text;
  std::vector<ExportLoss> losses;
  std::vector<std::string> warnings;
};

/// Writes the models in a format, then reads the text back, evaluates it in single precision as the
/// target would, and compares, over the whole range.
/// @return mismatch when the axes are of different boards or temperature scales, an axis comes
/// twice,
///         or the text read back is not what was meant to be written; out_of_range for an instance
///         the target does not have or a range it cannot hold; bad_input for a name that could not
///         stand in every format.
[[nodiscard]] Result<FirmwareFile> export_firmware(const FirmwareRequest& request);

}  // namespace gyrocal
