#include <fmt/core.h>

#include <numbers>

#include "compensation/firmware/ardupilot.h"
#include "compensation/firmware/comparison.h"

namespace gyrocal {
namespace {

constexpr double dps_per_rad_s = 180 / std::numbers::pi;

/// PX4 and ArduPilot keep one temperature range for all axes of a sensor.
Result<void> check_one_range(const std::vector<AxisCurve>& curves) {
  const auto& first = curves.front().curve.axis.setpoints_c;
  for (const auto& [identity, curve] : curves) {
    if (curve.axis.setpoints_c.front() != first.front() ||
        curve.axis.setpoints_c.back() != first.back()) {
      return fail(Errc::mismatch, "the axes were calibrated over different temperature ranges",
                  "export them one by one, or from one campaign");
    }
  }
  return {};
}

Result<void> check_px4(const FirmwareRequest& request) {
  if (request.instance >= 0 && request.instance <= 3) return {};
  return fail(Errc::out_of_range, fmt::format("PX4 has no TC_G{}", request.instance),
              "choose an instance of 0 to 3");
}

Result<void> check_ardupilot(const FirmwareRequest& request, const IndexAxis& axis) {
  if (request.instance < 0 || request.instance > 2) {
    return fail(Errc::out_of_range,
                fmt::format("ArduPilot has no INS_TCAL{}", request.instance + 1),
                "choose an instance of 0 to 2 (IMU 1 to 3)");
  }
  const double low = axis.setpoints_c.front();
  const double high = axis.setpoints_c.back();
  if (low >= -70 && high <= 80 && high - low >= 10) return {};
  return fail(Errc::out_of_range,
              fmt::format("ArduPilot takes a range of at least 10 K within -70 to 80 degC; the "
                          "model's is {:g} to {:g}",
                          low, high),
              "calibrate over another range");
}

void warn_of_cubic_loss(FirmwareFile& file, const FirmwareRequest& request) {
  for (std::size_t i = 0; i < file.losses.size(); ++i) {
    const auto& model = request.axes[i].model;
    if (file.losses[i].form_rms_dps > 0.1 * model.loocv_rmse_dps) {
      file.warnings.push_back(fmt::format(
          "axis {}: a cubic cannot follow {}: {:.4f} deg/s RMS are lost beside a leave-one-out "
          "error of {:.4f}",
          file.losses[i].axis, model.method, file.losses[i].form_rms_dps, model.loocv_rmse_dps));
    }
  }
}

/// What the target makes of the text, as a function of temperature in its own precision.
Result<std::function<float(float)>> evaluated_by_target(const FirmwareRequest& request,
                                                        const std::string& text,
                                                        const std::string& axis) {
  if (request.format == FirmwareFormat::px4) {
    const auto gyro = read_px4_text(text, request.instance, axis);
    if (!gyro) return tl::unexpected(gyro.error());
    return [gyro = *gyro](float t) { return offset_rad_s(gyro, t); };
  }
  const auto gyro = read_ardupilot_text(text, request.instance + 1, axis);
  if (!gyro) return tl::unexpected(gyro.error());
  return [gyro = *gyro](float t) { return offset_rad_s(gyro, t); };
}

}  // namespace

Result<FirmwareFile> export_cubics(const FirmwareRequest& request,
                                   const std::vector<AxisCurve>& curves,
                                   const std::string& comment) {
  const bool px4 = request.format == FirmwareFormat::px4;
  auto possible = px4 ? check_px4(request) : check_ardupilot(request, curves.front().curve.axis);
  if (possible) possible = check_one_range(curves);
  if (!possible) return tl::unexpected(std::move(possible.error()));

  std::vector<AxisCubic> axes;
  for (const auto& [identity, curve] : curves) {
    auto cubic = nearest_cubic(curve, px4 ? px4_reference_c : ardupilot_reference_c);
    if (!cubic) return tl::unexpected(std::move(cubic.error()));
    axes.push_back({identity, *cubic});
  }
  FirmwareFile file;
  file.text = px4 ? px4_text(axes, request.instance, request.device_id, comment)
                  : ardupilot_text(axes, request.instance + 1, comment);
  for (std::size_t i = 0; i < axes.size(); ++i) {
    const auto target = evaluated_by_target(request, file.text, axes[i].identity.axis);
    if (!target) return tl::unexpected(target.error());
    auto loss = compared({curves[i], [&](double t) { return value_at(axes[i].cubic, t); },
                          [&](float t) { return static_cast<float>((*target)(t)*dps_per_rad_s); }});
    if (!loss) return tl::unexpected(std::move(loss.error()));
    file.losses.push_back(std::move(*loss));
  }
  if (px4 && !request.device_id) {
    file.warnings.push_back(
        fmt::format("without a device id PX4 does not apply these parameters: set TC_G{}_ID",
                    request.instance));
  }
  warn_of_cubic_loss(file, request);
  return file;
}

}  // namespace gyrocal
