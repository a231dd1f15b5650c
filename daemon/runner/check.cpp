#include "daemon/runner/check.h"

#include <fmt/core.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "daemon/runner/analysis.h"
#include "daemon/runner/device_lock.h"
#include "daemon/runner/disk_room.h"
#include "daemon/runner/progress.h"

namespace gyrocal::runner {
namespace {

constexpr double megabyte = 1e6;

std::string text_of(const ChamberReading& reading) {
  std::string text = fmt::format("{:.1f} degC, setpoint {:.1f} degC", reading.actual.value,
                                 reading.setpoint.value);
  if (reading.run) text += fmt::format(", {}", name_of(*reading.run));
  return text;
}

Result<std::string> look_at_board(const BoardConfig& config, Board& board, const BoardMode& mode,
                                  Clock& clock, Duration patience) {
  auto identity = inspect_board(config, board, mode, clock, patience);
  if (!identity) return tl::unexpected(identity.error());
  if (auto stopped = board.stop(); !stopped) return tl::unexpected(stopped.error());
  return fmt::format("MCU id {}, {}, streams at {} Hz", identity->mcu_id,
                     identity->firmware_version, mode.sample_rate_hz);
}

std::pair<double, double> span(const std::vector<Celsius>& setpoints) {
  const auto [low, high] = std::minmax_element(setpoints.begin(), setpoints.end());
  return {low->value, high->value};
}

}  // namespace

bool CheckReport::passed() const {
  return fits() && std::all_of(devices.begin(), devices.end(),
                               [](const CheckedDevice& d) { return d.found.has_value(); });
}

Result<CheckReport> check_campaign(const CampaignConfig& config, Devices& devices,
                                   Duration patience, const std::string& database) {
  auto plan = campaign::make_plan(config);
  if (!plan) return tl::unexpected(plan.error());
  if (auto filter = denoise_settings(config.analysis); !filter) {
    return tl::unexpected(filter.error());
  }
  CheckReport report;
  report.plan = *plan;
  report.database = database;
  report.bytes_free = disk_room(database).value_or(0);
  const auto chamber = inspect_chamber(config, devices.chamber);
  report.cost = estimate(*plan, chamber ? chamber->actual : plan->safe);
  report.devices.push_back(
      {"chamber", chamber_name(config.chamber),
       chamber ? Result<std::string>(text_of(*chamber)) : tl::unexpected(chamber.error())});
  const BoardMode mode{config.plan.sample_rate_hz, false, true};
  for (std::size_t i = 0; i < config.boards.size(); ++i) {
    report.devices.push_back(
        {config.boards[i].name, config.boards[i].device,
         look_at_board(config.boards[i], *devices.boards[i], mode, devices.clock, patience)});
  }
  return report;
}

std::string check_text(const CheckReport& report) {
  const auto& plan = report.plan;
  const auto [low, high] = span(plan.setpoints);
  std::string text;
  const auto row = [&](const std::string& name, const std::string& what) {
    text += fmt::format("{:<10} {}\n", name, what);
  };
  row("plan", fmt::format("{} setpoints from {:.1f} to {:.1f} degC, {} samples each at {} Hz from "
                          "{} boards",
                          plan.setpoints.size(), low, high, plan.samples_per_dwell,
                          plan.sample_rate_hz, plan.boards.size()));
  row("limits", fmt::format("{:.1f} to {:.1f} degC, what boards and chamber allow together; safe "
                            "setpoint {:.1f} degC",
                            plan.allowed.min.value, plan.allowed.max.value, plan.safe.value));
  row("duration",
      fmt::format("{} to {} (h:min:s) if nothing is disturbed: ramps as asked{}, soaks from {:.0f} "
                  "min on, until the air is steady",
                  clock_text(report.cost.duration), clock_text(report.cost.duration_max),
                  plan.cooling_per_minute ? " or as slow as the chamber's profile says" : "",
                  std::max(plan.stability.air_window_s, plan.stability.soak_s_min) / 60));
  row("disk",
      fmt::format("{:.1f} MB needed for {}, {:.1f} MB free{}", double(report.cost.bytes) / megabyte,
                  report.database, double(report.bytes_free) / megabyte,
                  report.fits() ? "" : ": TOO LITTLE"));
  for (const auto& device : report.devices) {
    row(device.name, device.found ? fmt::format("{}: {}", device.where, *device.found)
                                  : fmt::format("FAILS: {}", to_text(device.found.error())));
  }
  return text;
}

std::string check_json(const CheckReport& report) {
  const auto& plan = report.plan;
  nlohmann::ordered_json setpoints = nlohmann::ordered_json::array();
  for (const Celsius c : plan.setpoints) setpoints.push_back(c.value);
  nlohmann::ordered_json devices = nlohmann::ordered_json::array();
  for (const auto& device : report.devices) {
    nlohmann::ordered_json one{{"name", device.name}, {"where", device.where}};
    if (device.found) {
      one["found"] = *device.found;
    } else {
      one["error"] = device.found.error().what;
      one["advice"] = device.found.error().advice;
    }
    devices.push_back(one);
  }
  return nlohmann::ordered_json{{"passed", report.passed()},
                                {"setpoints_c", setpoints},
                                {"limit_min_c", plan.allowed.min.value},
                                {"limit_max_c", plan.allowed.max.value},
                                {"safe_setpoint_c", plan.safe.value},
                                {"duration_s", to_seconds(report.cost.duration)},
                                {"duration_max_s", to_seconds(report.cost.duration_max)},
                                {"samples", report.cost.samples},
                                {"bytes_needed", report.cost.bytes},
                                {"bytes_free", report.bytes_free},
                                {"database", report.database},
                                {"devices", devices}}
      .dump();
}

}  // namespace gyrocal::runner
