#include "config/campaign_sections.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <string_view>

#include "compensation/wavelet/boundary.h"
#include "compensation/wavelet/denoise.h"
#include "compensation/wavelet/filter_bank.h"
#include "config/setpoints.h"

namespace gyrocal {
namespace {

using namespace std::string_view_literals;
namespace fs = std::filesystem;

constexpr NumberRange physical_c{-273.15, 1000, "degC"};

int whole(TomlSection& table, std::string_view key, int fallback, NumberRange range) {
  return static_cast<int>(table.integer(key, fallback, range));
}

/// One number a table key, in place: the fallback is what the field holds.
void number(TomlSection& table, std::string_view key, double& field, NumberRange range) {
  field = table.number(key, field, range);
}

}  // namespace

CampaignSections::CampaignSections(TomlSection& root)
    : general(root.section("campaign")),
      plan(root.section("plan")),
      chamber(root.section("chamber")),
      stability(root.section("stability")),
      limits(root.section("limits")),
      analysis(root.section("analysis")),
      acceptance(root.section("acceptance")),
      boards(root.sections("board")) {}

void CampaignSections::refuse_unknown_keys() {
  for (auto* table : {&general, &plan, &chamber, &stability, &limits, &analysis, &acceptance}) {
    table->refuse_unknown_keys();
  }
  for (auto& board : boards) board.refuse_unknown_keys();
}

void read_general(TomlSection& table, const std::string& path, CampaignConfig& into) {
  into.name = table.required_text("name", "a name for this campaign; its database is NAME.db");
  if (into.name.find_first_of("/\n") != std::string::npos) {
    table.expected("name", Errc::bad_input, "a name without slashes and line breaks");
  }
  into.simulated = table.flag("simulated", into.simulated);
  number(table, "time_scale", into.time_scale, {0.001, 100000});
  const fs::path database = table.text("database", into.name + ".db");
  into.database = (fs::path(path).parent_path() / database).lexically_normal().string();
}

void read_plan(TomlSection& table, PlanConfig& into) {
  std::vector<double> listed_c;
  for (const Celsius point : paper_setpoints()) listed_c.push_back(point.value);
  for (const double c : table.numbers("setpoints_c", listed_c, physical_c)) {
    into.setpoints.push_back({c});
  }
  constexpr std::array sweeps{"up"sv, "up_down"sv, "shuffled"sv, "as_listed"sv};
  into.sweep = static_cast<Sweep>(table.choice("sweep", 0, sweeps));
  into.shuffle_seed = static_cast<std::uint64_t>(table.integer("shuffle_seed", 1, {0, 1e15}));
  into.samples_per_setpoint =
      whole(table, "samples_per_setpoint", into.samples_per_setpoint, {1, 10e6});
  into.sample_rate_hz = whole(table, "sample_rate_hz", into.sample_rate_hz, {1, 400, "Hz"});
  const auto& rates = known_sample_rates_hz;
  if (std::find(rates.begin(), rates.end(), into.sample_rate_hz) == rates.end()) {
    table.expected("sample_rate_hz", Errc::out_of_range,
                   "a rate the iNEMO firmware knows: 1, 10, 25, 30, 50, 100 or 400 [Hz]");
  }
  number(table, "ramp_k_per_min", into.ramp_per_minute.value, {0.01, 20, "K/min"});
  number(table, "safe_setpoint_c", into.safe_setpoint.value, physical_c);
}

void read_boards(TomlSection& root, std::vector<TomlSection>& tables,
                 std::vector<BoardConfig>& into) {
  if (!root.has("board")) {
    root.expected("board", Errc::bad_input, "at least one [[board]] with name and device");
  }
  constexpr NumberRange scale{0.01, 10000, "LSB/(deg/s)"};
  constexpr NumberRange scale_slope{-100, 100, "LSB/(deg/s)/K"};
  const auto three = [](TomlSection& table, std::string_view key, std::array<double, 3>& field,
                        NumberRange range) {
    const auto values = table.numbers(key, {field.begin(), field.end()}, range);
    if (values.size() == 3) {
      std::copy(values.begin(), values.end(), field.begin());
    } else {
      table.expected(key, Errc::bad_input, "three numbers, for X, Y and Z");
    }
  };
  for (auto& table : tables) {
    BoardConfig board;
    board.name = table.required_text("name", "a name unique in this campaign");
    board.device = table.required_text("device", "its stable link, /dev/serial/by-id/...");
    if (table.has("mcu_id")) {
      board.mcu_id = table.text("mcu_id", "");
      constexpr auto hex = "0123456789abcdefABCDEF";
      if (board.mcu_id->size() != 24 || board.mcu_id->find_first_not_of(hex) != std::string::npos) {
        table.expected("mcu_id", Errc::bad_input, "24 hex digits, as `gyrocal check` prints them");
      }
    }
    three(table, "lsb_per_dps", board.lsb_per_dps, scale);
    three(table, "lsb_per_dps_per_k", board.lsb_per_dps_per_k, scale_slope);
    number(table, "limit_min_c", board.limit_min.value, physical_c);
    number(table, "limit_max_c", board.limit_max.value, physical_c);
    into.push_back(std::move(board));
  }
}

void read_stability(TomlSection& table, StabilityConfig& into) {
  constexpr NumberRange kelvin{0.001, 20, "K"};
  constexpr NumberRange wait{0, 7 * 86400, "s"};
  number(table, "air_band_k", into.air_band.value, kelvin);
  number(table, "air_peak_to_peak_k", into.air_peak_to_peak.value, kelvin);
  number(table, "air_window_s", into.air_window_s, {1, 86400, "s"});
  number(table, "board_slope_k_per_h", into.board_slope_k_per_h, {0.01, 1000, "K/h"});
  number(table, "board_window_s", into.board_window_s, {1, 86400, "s"});
  number(table, "soak_s_min", into.soak_s_min, wait);
  number(table, "soak_s_max", into.soak_s_max, wait);
}

void read_limits(TomlSection& table, LimitConfig& into) {
  constexpr NumberRange wait{0.1, 7 * 86400, "s"};
  number(table, "chamber_stale_s", into.chamber_stale_s, wait);
  number(table, "board_stale_s", into.board_stale_s, wait);
  number(table, "ramp_timeout_factor", into.ramp_timeout_factor, {1, 100});
  number(table, "ramp_timeout_extra_s", into.ramp_timeout_extra_s, {0, 7 * 86400, "s"});
  number(table, "frames_lost_share_max", into.frames_lost_share_max, {0, 1});
  into.dwell_attempts_max = whole(table, "dwell_attempts_max", into.dwell_attempts_max, {1, 100});
  number(table, "board_away_s_max", into.board_away_s_max, wait);
  number(table, "dwell_band_k", into.dwell_band.value, {0.001, 20, "K"});
}

void read_acceptance(TomlSection& table, AcceptanceConfig& into) {
  constexpr NumberRange error{0, 1000, "deg/s"};
  // Both keys are known, there or not.
  const double pass_dps = table.number("pass_dps", 0, error);
  const double reject_dps = table.number("reject_dps", pass_dps, error);
  if (table.has("pass_dps")) into.pass_dps = pass_dps;
  if (table.has("reject_dps")) into.reject_dps = reject_dps;
  if (into.reject_dps && (!into.pass_dps || *into.reject_dps < *into.pass_dps)) {
    table.expected("reject_dps", Errc::out_of_range,
                   "at least pass_dps, which must stand beside it");
  }
}

void read_analysis(TomlSection& table, AnalysisConfig& into) {
  // The wavelet library owns the lists of names.
  const auto known = [&table](std::string_view key, const auto& found) {
    if (!found) table.expected(key, Errc::unknown_name, "one of the " + found.error().advice);
  };
  into.wavelet = table.text("wavelet", into.wavelet);
  known("wavelet", find_filter_bank(into.wavelet));
  into.mode = table.text("mode", into.mode);
  known("mode", find_boundary(into.mode));
  into.level = whole(table, "level", into.level, {1, 20});
  into.rule = table.text("rule", into.rule);
  known("rule", find_denoise_rule(into.rule));
}

}  // namespace gyrocal
