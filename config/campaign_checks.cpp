#include "config/campaign_checks.h"

#include <fmt/core.h>

#include <algorithm>

#include "compensation/wavelet/dwt.h"

namespace gyrocal {
namespace {

void check_boards(CampaignSections& sections, const CampaignConfig& campaign) {
  for (std::size_t i = 0; i < campaign.boards.size(); ++i) {
    const BoardConfig& board = campaign.boards[i];
    TomlSection& table = sections.boards[i];
    if (board.limit_min >= board.limit_max) {
      table.expected("limit_min_c", Errc::out_of_range,
                     fmt::format("less than limit_max_c, {}", board.limit_max.value));
    }
    for (std::size_t j = 0; j < i; ++j) {
      const BoardConfig& other = campaign.boards[j];
      if (other.name == board.name) {
        table.expected("name", Errc::bad_input,
                       fmt::format("a name unique in this campaign; board[{}] has it already", j));
      }
      if (other.device == board.device) {
        table.expected("device", Errc::bad_input,
                       fmt::format("a device of its own; board \"{}\" has it already", other.name));
      }
      if (board.mcu_id && other.mcu_id == board.mcu_id) {
        table.expected("mcu_id", Errc::bad_input,
                       fmt::format("an id of its own; board \"{}\" has it already", other.name));
      }
    }
    const auto* rtu = std::get_if<RtuAddress>(&campaign.chamber.address);
    if (rtu != nullptr && rtu->device == board.device) {
      table.expected("device", Errc::bad_input, "a device of its own; the chamber has it already");
    }
  }
}

/// Who sets an end of the allowed range, for the message.
std::string who_allows(const CampaignConfig& campaign, const SetpointRange& range) {
  const auto& profile = campaign.chamber.profile;
  std::string low = fmt::format("chamber \"{}\"", profile.name);
  std::string high = low;
  for (const BoardConfig& board : campaign.boards) {
    if (board.limit_min == range.min && board.limit_min > profile.limit_min) {
      low = fmt::format("board \"{}\"", board.name);
    }
    if (board.limit_max == range.max && board.limit_max < profile.limit_max) {
      high = fmt::format("board \"{}\"", board.name);
    }
  }
  return fmt::format("from {} ({}) to {} ({}) [degC]", range.min.value, low, range.max.value, high);
}

void check_setpoints(CampaignSections& sections, const CampaignConfig& campaign) {
  const SetpointRange range = allowed_setpoints(campaign);
  const std::string allowed = who_allows(campaign, range);
  const auto outside = [&range](Celsius c) { return c < range.min || c > range.max; };
  const auto& points = campaign.plan.setpoints;
  for (const Celsius& point : points) {
    if (outside(point)) {
      sections.plan.expected("setpoints_c", Errc::out_of_range,
                             fmt::format("setpoints {}, not {}", allowed, point.value));
    }
    const bool sorted = campaign.plan.sweep == Sweep::up || campaign.plan.sweep == Sweep::up_down;
    if (sorted && &point == &*std::find(points.begin(), points.end(), point) &&
        std::count(points.begin(), points.end(), point) > 1) {
      sections.plan.expected(
          "setpoints_c", Errc::bad_input,
          fmt::format("{} once in this sweep; sweep = \"as_listed\" allows revisits", point.value));
    }
  }
  if (outside(campaign.plan.safe_setpoint)) {
    sections.plan.expected(
        "safe_setpoint_c", Errc::out_of_range,
        fmt::format("a setpoint {}, not {}", allowed, campaign.plan.safe_setpoint.value));
  }
}

void check_waits(CampaignSections& sections, const CampaignConfig& campaign) {
  const StabilityConfig& stability = campaign.stability;
  const auto too_long = [&](const char* key, double window_s) {
    if (window_s <= stability.soak_s_max) return;
    sections.stability.expected(
        key, Errc::out_of_range,
        fmt::format("at most soak_s_max, {} s: it could never be met", stability.soak_s_max));
  };
  too_long("soak_s_min", stability.soak_s_min);
  too_long("air_window_s", stability.air_window_s);
  too_long("board_window_s", stability.board_window_s);
  if (campaign.limits.dwell_band < stability.air_band) {
    sections.limits.expected("dwell_band_k", Errc::out_of_range,
                             fmt::format("at least stability.air_band_k, {} K: every dwell would "
                                         "be rejected",
                                         stability.air_band.value));
  }
  const double poll_s = campaign.chamber.poll_interval_s;
  if (campaign.limits.chamber_stale_s <= poll_s) {
    sections.limits.expected(
        "chamber_stale_s", Errc::out_of_range,
        fmt::format("more than chamber.poll_interval_s, {} s: every reading would be stale",
                    poll_s));
  }
}

void check_level(CampaignSections& sections, const CampaignConfig& campaign) {
  const int deepest = deepest_level(static_cast<std::size_t>(campaign.plan.samples_per_setpoint));
  if (campaign.analysis.level <= deepest) return;
  sections.analysis.expected("level", Errc::out_of_range,
                             fmt::format("at most {}: a dwell has {} samples", deepest,
                                         campaign.plan.samples_per_setpoint));
}

}  // namespace

void check_together(CampaignSections& sections, const CampaignConfig& campaign) {
  if (campaign.time_scale != 1.0 && !campaign.simulated) {
    sections.general.expected("time_scale", Errc::bad_input,
                              "1: only simulated devices can run faster (simulated = true)");
  }
  check_boards(sections, campaign);
  check_setpoints(sections, campaign);
  check_waits(sections, campaign);
  check_level(sections, campaign);
}

}  // namespace gyrocal
