#pragma once

#include <functional>

#include "compensation/drift/curve.h"
#include "compensation/firmware/export.h"

namespace gyrocal {

struct AxisCurve {
  SensorIdentity identity;
  DriftCurve curve;
};

/// The same drift three ways: the model, the form the file can hold (rows, a cubic), and what the
/// file's text evaluates to in single precision [deg/s].
struct Comparison {
  const AxisCurve& axis;
  std::function<double(double)> form;
  std::function<float(float)> text;
};

/// Over 2001 temperatures of the model's range.
/// @return mismatch when text and form differ by more than 1e-4 deg/s.
[[nodiscard]] Result<ExportLoss> compared(const Comparison& way);

/// One file each kind of form; `comment` stands at its head.
[[nodiscard]] Result<FirmwareFile> export_tables(const FirmwareRequest& request,
                                                 const std::vector<AxisCurve>& curves,
                                                 const std::string& comment);
[[nodiscard]] Result<FirmwareFile> export_cubics(const FirmwareRequest& request,
                                                 const std::vector<AxisCurve>& curves,
                                                 const std::string& comment);

}  // namespace gyrocal
