#include "compensation/firmware/export.h"

#include <fmt/ranges.h>

#include <array>
#include <cmath>

#include "compensation/firmware/comparison.h"
#include "compensation/values/nearest_name.h"

namespace gyrocal {
namespace {

constexpr std::array<std::pair<FirmwareFormat, std::string_view>, 5> format_names{{
    {FirmwareFormat::c, "c"},
    {FirmwareFormat::px4, "px4"},
    {FirmwareFormat::ardupilot, "ardupilot"},
    {FirmwareFormat::csv, "csv"},
    {FirmwareFormat::json, "json"},
}};

Result<void> check_names(const SensorIdentity& identity) {
  constexpr std::string_view allowed =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789 ._:/+-";
  for (const auto* name : {&identity.board, &identity.temperature_scale}) {
    if (name->find_first_not_of(allowed) != std::string::npos) {
      return fail(Errc::bad_input,
                  fmt::format("the name \"{}\" cannot stand in every format", *name),
                  "use letters, digits, blanks and ._:/+-");
    }
  }
  if (identity.axis != "x" && identity.axis != "y" && identity.axis != "z") {
    return fail(Errc::bad_input,
                fmt::format("the model's axis is \"{}\", expected x, y or z", identity.axis),
                "state the axis");
  }
  return {};
}

/// One file is for one board, on one thermometer.
Result<void> check_same_board(const SensorIdentity& a, const SensorIdentity& b) {
  if (a.board == b.board && a.temperature_scale == b.temperature_scale) return {};
  return fail(
      Errc::mismatch,
      fmt::format("axis {} is of board \"{}\" over temperature scale \"{}\", axis {} of "
                  "\"{}\" over \"{}\"",
                  a.axis, a.board, a.temperature_scale, b.axis, b.board, b.temperature_scale),
      "export each board by itself");
}

Result<std::vector<AxisCurve>> curves_of(const FirmwareRequest& request) {
  if (request.axes.empty()) return fail(Errc::bad_input, "no model was given to export");
  std::vector<AxisCurve> curves;
  for (const auto& [identity, model] : request.axes) {
    if (auto named = check_names(identity); !named) return tl::unexpected(named.error());
    for (const auto& earlier : curves) {
      if (earlier.identity.axis == identity.axis) {
        return fail(Errc::mismatch, fmt::format("axis {} is given twice", identity.axis),
                    "give one model for each axis");
      }
      if (auto same = check_same_board(earlier.identity, identity); !same) {
        return tl::unexpected(std::move(same.error()));
      }
    }
    auto curve = curve_of(model.method, model.parameters);
    if (!curve) return tl::unexpected(std::move(curve.error()));
    curves.push_back({identity, std::move(*curve)});
  }
  return curves;
}

std::string comment_of(const FirmwareRequest& request) {
  const auto stated = [](const std::string& name) { return name.empty() ? "not stated" : name; };
  const auto& first = request.axes.front().identity;
  std::string text = fmt::format(
      "Zero drift over temperature, made by gyrocal {}; do not edit.\n"
      "Board: {}. Temperature scale: {}.",
      request.software_version, stated(first.board), stated(first.temperature_scale));
  for (const auto& [identity, model] : request.axes) {
    text +=
        fmt::format("\nAxis {}: {}, {:g} to {:g} degC, {} setpoints", identity.axis, model.method,
                    model.setpoint_c.front(), model.setpoint_c.back(), model.setpoint_c.size());
    if (std::isfinite(model.loocv_rmse_dps)) {
      text += fmt::format(", leave-one-out error {:.4f} deg/s", model.loocv_rmse_dps);
    }
    text += ".";
  }
  return text;
}

}  // namespace

Result<FirmwareFormat> firmware_format_named(std::string_view name) {
  std::vector<std::string_view> known;
  for (const auto& [format, known_name] : format_names) {
    if (name == known_name) return format;
    known.push_back(known_name);
  }
  return fail(Errc::unknown_name, fmt::format("no firmware format is named \"{}\"", name),
              fmt::format("{}known: {}", is_meant(name, known), fmt::join(known, ", ")));
}

Result<FirmwareFile> export_firmware(const FirmwareRequest& request) {
  const auto curves = curves_of(request);
  if (!curves) return tl::unexpected(curves.error());
  const bool cubic =
      request.format == FirmwareFormat::px4 || request.format == FirmwareFormat::ardupilot;
  const std::string comment = comment_of(request);
  return cubic ? export_cubics(request, *curves, comment)
               : export_tables(request, *curves, comment);
}

}  // namespace gyrocal
