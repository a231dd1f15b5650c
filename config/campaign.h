#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "compensation/values/error.h"
#include "compensation/values/units.h"
#include "config/chamber_profile.h"

namespace gyrocal {

/// How the setpoints are visited: ascending; then down again without repeating the top; in an order
/// drawn from a seed; or as the file lists them, which allows revisits and reversals.
enum class Sweep { up, up_down, shuffled, as_listed };

/// Where the chamber is reached.
struct TcpAddress {
  std::string host;  ///< numeric address: libmodbus asks no name server
  int port = 502;
};
struct RtuAddress {
  std::string device;
  int baud = 9600;
  char parity = 'N';
  int stop_bits = 1;
};

struct ChamberConfig {
  ChamberProfile profile;
  std::variant<TcpAddress, RtuAddress> address;
  int unit = 1;
  double reply_timeout_s = 1.0;
  double poll_interval_s = 5.0;
};

struct BoardConfig {
  std::string name;                   ///< unique in the campaign; what reports call it
  std::string device;                 ///< stable link, /dev/serial/by-id/...
  std::optional<std::string> mcu_id;  ///< refuse another board, if given
  std::array<double, 3> lsb_per_dps{4.13, 4.13, 4.13};  ///< scale factor of X, Y, Z [LSB/(deg/s)]
  std::array<double, 3> lsb_per_dps_per_k{0, 0, 0};  ///< its temperature coefficient, about 20 degC
  Celsius limit_min{-20};                            ///< what the board may see
  Celsius limit_max{70};
};

struct PlanConfig {
  std::vector<Celsius> setpoints;  ///< in the order they are visited, sweep applied
  Sweep sweep = Sweep::up;
  std::uint64_t shuffle_seed = 1;
  int samples_per_setpoint = 3000;
  int sample_rate_hz = 50;
  Kelvin ramp_per_minute{1.0};  ///< software ramp of the setpoint
  Celsius safe_setpoint{25};    ///< where every ending leaves the chamber
};

/// When air and board count as stable, and how long anything may take.
struct StabilityConfig {
  Kelvin air_band{0.3};          ///< |air - setpoint| at most, all through the window
  Kelvin air_peak_to_peak{0.2};  ///< within the window; the cycling of the chamber counts
  double air_window_s = 600;
  double board_slope_k_per_h = 2.0;  ///< least-squares slope of the board's sensor at most
  double board_window_s = 900;
  double soak_s_min = 1800;  ///< at least this long in the band; the timed soak's length
  double soak_s_max = 7200;  ///< then the setpoint has failed
};

struct LimitConfig {
  double chamber_stale_s = 30;     ///< no good reading for so long is a fault
  double board_stale_s = 10;       ///< no frame for so long: the board is away
  double ramp_timeout_factor = 2;  ///< expected ramp times this, plus ramp_timeout_extra_s
  double ramp_timeout_extra_s = 1800;
  double frames_lost_share_max = 0.01;  ///< of a dwell; beyond it the dwell is rejected
  int dwell_attempts_max = 3;
  double board_away_s_max = 3600;  ///< then the campaign goes on without it
  Kelvin dwell_band{0.5};          ///< air leaving it while logging rejects the dwell
};

struct AnalysisConfig {
  std::string wavelet = "db4";
  std::string mode = "symmetric";
  int level = 5;
  std::string rule = "approximation";
};

/// What a report holds the recommended model's held-out error against. Absent: not judged.
struct AcceptanceConfig {
  std::optional<double> pass_dps;    ///< at most: PASS
  std::optional<double> reject_dps;  ///< above: REJECT; between: MARGINAL. Default: pass_dps
};

/// A whole campaign file, checked: every number finite and in range, every name unique.
struct CampaignConfig {
  std::string name;
  bool simulated = false;  ///< the devices are `gyrocal rig serve`; allows time_scale
  double time_scale = 1.0;
  std::string database;  ///< path; default NAME.db beside the campaign file
  PlanConfig plan;
  ChamberConfig chamber;
  std::vector<BoardConfig> boards;
  StabilityConfig stability;
  LimitConfig limits;
  AnalysisConfig analysis;
  AcceptanceConfig acceptance;
  std::string text;  ///< the file as read: provenance
};

/// Reads and checks a campaign file. Relative paths in it are relative to its folder; a chamber
/// profile is looked up beside the file, then in the installed and the source tree's profiles.
/// @return bad_input, unknown_name, out_of_range, not_finite or storage; `what` names file, line,
///   key, what stands there and what was expected.
[[nodiscard]] Result<CampaignConfig> read_campaign(const std::string& path);

/// Same, from text; `path` only names it in messages and anchors relative paths.
/// @param profile  the chamber's, if it is at hand; else it is looked up.
[[nodiscard]] Result<CampaignConfig> parse_campaign(
    const std::string& text, const std::string& path,
    const std::optional<ChamberProfile>& profile = std::nullopt);

/// The file a profile's name stands for, "yinhe": in the campaign's folder first, so that a site
/// can keep its own, then among the site's, the installed and the source tree's. A path stands for
/// itself, from the campaign's folder.
[[nodiscard]] std::optional<std::string> find_chamber_profile(const std::string& profile,
                                                              const std::string& campaign_folder);

/// Plan and limits met: plan ∩ boards ∩ chamber; what the setpoint is clamped to.
struct SetpointRange {
  Celsius min;
  Celsius max;
};
[[nodiscard]] SetpointRange allowed_setpoints(const CampaignConfig& campaign);

/// The sample rates the iNEMO firmware knows [Hz].
inline constexpr std::array<int, 7> known_sample_rates_hz{1, 10, 25, 30, 50, 100, 400};

}  // namespace gyrocal
