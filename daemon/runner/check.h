#pragma once

#include <string>
#include <vector>

#include "daemon/campaign/plan.h"
#include "daemon/runner/preflight.h"

namespace gyrocal::runner {

/// One device as the check found it, or why it did not.
struct CheckedDevice {
  std::string name;
  std::string where;
  Result<std::string> found;
};

/// What a person wants to know before the weekend.
struct CheckReport {
  campaign::Plan plan;
  campaign::Estimate cost;
  std::string database;
  std::uintmax_t bytes_free = 0;
  std::vector<CheckedDevice> devices;  ///< the chamber, then the boards
  [[nodiscard]] bool fits() const { return cost.bytes < bytes_free; }
  [[nodiscard]] bool passed() const;
};

/// Reads chamber and boards and costs the plan. Writes nothing to the chamber and nothing to disk.
/// A device that fails does not keep the others from being looked at.
/// @return what make_plan() and denoise_settings() refuse.
[[nodiscard]] Result<CheckReport> check_campaign(const CampaignConfig& config, Devices& devices,
                                                 Duration patience, const std::string& database);

[[nodiscard]] std::string check_text(const CheckReport& report);
[[nodiscard]] std::string check_json(const CheckReport& report);

}  // namespace gyrocal::runner
