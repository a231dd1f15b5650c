#include "daemon/runner/machine_watch.h"

#include <fmt/core.h>

#include <cmath>

namespace gyrocal::runner {
namespace {

constexpr double step_s_min = 5;  ///< of UTC; NTP slews less between two looks
constexpr std::uintmax_t little_bytes = 100'000'000;
constexpr std::uintmax_t full_bytes = 20'000'000;  ///< room for the last groups and the models

}  // namespace

std::vector<MachineNotice> MachineWatch::look(Duration t, std::int64_t utc_ns,
                                              std::uintmax_t bytes_free) {
  std::vector<MachineNotice> notices;
  if (auto notice = clocks(t, utc_ns)) notices.push_back(*notice);
  if (auto notice = disk(bytes_free)) notices.push_back(*notice);
  return notices;
}

std::optional<MachineNotice> MachineWatch::clocks(Duration t, std::int64_t utc_ns) {
  const auto before = last_t_;
  const double utc_s = double(utc_ns - last_utc_ns_) * 1e-9;
  last_t_ = t;
  last_utc_ns_ = utc_ns;
  if (!before) return std::nullopt;
  const double ahead_s = utc_s - to_seconds(t - *before) / utc_rate_;
  if (std::abs(ahead_s) < step_s_min) return std::nullopt;
  if (ahead_s < 0) {
    return MachineNotice{
        "warning", "clock_step",
        fmt::format("UTC was set back by {:.0f} s; no duration is taken from it", -ahead_s)};
  }
  return MachineNotice{
      "warning", "clock_step",
      fmt::format("UTC is {:.0f} s ahead of the steady clock since the last look: "
                  "it was set, or the machine slept and nobody watched the chamber",
                  ahead_s),
      true};
}

std::optional<MachineNotice> MachineWatch::disk(std::uintmax_t bytes_free) {
  if (bytes_free >= little_bytes) {
    little_told_ = false;
    full_told_ = false;
    return std::nullopt;
  }
  const bool full = bytes_free < full_bytes;
  if (full ? full_told_ : little_told_) return std::nullopt;
  little_told_ = true;
  full_told_ = full;
  MachineNotice notice{
      full ? "error" : "warning", "disk_space",
      fmt::format("{:.0f} MB are left for the database", double(bytes_free) / 1e6)};
  notice.disk_full = full;
  return notice;
}

}  // namespace gyrocal::runner
