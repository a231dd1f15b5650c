#include "tests/hidden_effects/fast_cases.h"

#include <algorithm>
#include <cmath>

#include "tests/hidden_effects/planted.h"

namespace hidden {
namespace {

/// Planting changes the case; the sizes follow what stacked dwells can show, in units of sigma.
using Plant = Hidden (*)(Case&, bool strong, Random&);

Hidden truth_of(const std::string& name, const std::string& law, Amplitude amplitude) {
  Hidden truth;
  truth.name = name;
  truth.law = law;
  truth.amplitude = std::move(amplitude);
  return truth;
}

/// Noise per root hertz against that of a quiet part, 0.1 deg/s at 50 Hz.
double noisiness(const Case& in) {
  return in.setting.white_per_root_hz() / (0.1 / std::sqrt(50.0));
}

double alias_hz(double line_hz, double rate_hz) {
  const double turns = line_hz / rate_hz;
  return rate_hz * std::abs(turns - std::round(turns));
}

/// Clear of zero and of half the rate, where a line would be something else.
bool shows_as_line(double line_hz, double rate_hz) {
  const double seen_hz = alias_hz(line_hz, rate_hz);
  return seen_hz > 0.7 && seen_hz < 0.5 * rate_hz - 0.5;
}

Hidden vibration(Case& in, bool strong, Random& random) {
  Sensor& sensor = in.setting.sensor;
  const double line =
      sensor.white_dps * (strong ? random.uniform(0.35, 0.6) : random.uniform(0.18, 0.22));
  double rotor_hz = 0.0;
  do {
    rotor_hz = random.pick(std::vector<double>{24.3, 29.2, 48.6, 58.3}) + random.uniform(-0.4, 0.4);
  } while (!shows_as_line(rotor_hz, sensor.rate_hz));
  const double step = random.uniform(0.1, 0.3) * line;
  sensor.vibration = Vibration{line, step, rotor_hz, random.uniform(0.005, 0.03)};
  Hidden truth = truth_of("compressor_vibration", "slipping_rotor",
                          {line, "dps", "amplitude of the line while the compressor runs"});
  truth.also.push_back({step, "dps", "step of the bias while it runs"});
  truth.parameters = {{"rotor_hz", rotor_hz}, {"alias_hz", alias_hz(rotor_hz, sensor.rate_hz)}};
  return truth;
}

Hidden hum(Case& in, bool strong, Random& random) {
  Sensor& sensor = in.setting.sensor;
  const double line =
      sensor.white_dps * (strong ? random.uniform(0.35, 0.6) : random.uniform(0.16, 0.2));
  double grid_hz = random.chance(0.5) ? 50.0 : 60.0;
  if (!shows_as_line(grid_hz, sensor.rate_hz)) grid_hz = 110.0 - grid_hz;
  sensor.hum = Hum{line, grid_hz, 0.3};
  Hidden truth =
      truth_of("mains_hum", "wandering_grid", {line, "dps", "amplitude at the grid's frequency"});
  truth.parameters = {{"grid_hz", grid_hz}, {"alias_hz", alias_hz(grid_hz, sensor.rate_hz)}};
  return truth;
}

Hidden telegraph(Case& in, bool strong, Random& random) {
  Sensor& sensor = in.setting.sensor;
  const double height =
      sensor.white_dps * (strong ? random.uniform(1.2, 1.8) : random.uniform(0.75, 0.9));
  sensor.telegraph = Telegraph{height, random.uniform(0.8, 3.0), random.uniform(0.8, 3.0), 0.02};
  Hidden truth =
      truth_of("random_telegraph_noise", "warmed_trap", {height, "dps", "between the two levels"});
  truth.parameters = {{"low_s", sensor.telegraph->low_s}, {"high_s", sensor.telegraph->high_s}};
  return truth;
}

Hidden instability(Case& in, bool strong, Random& random) {
  const double b_deg_h = std::min(
      60.0, noisiness(in) * (strong ? random.uniform(45.0, 60.0) : random.uniform(18.0, 24.0)));
  in.flicker_dps = b_deg_h / 3600.0;
  return truth_of("bias_instability", "fractional_difference",
                  {b_deg_h, "deg/h", "B in S = B^2/(2 pi f)"});
}

Hidden walk(Case& in, bool strong, Random& random) {
  const double k = std::min(
      0.5, noisiness(in) * (strong ? random.uniform(0.25, 0.4) : random.uniform(0.1, 0.13)));
  in.walk_dps_per_root_s = 1e-3 * k;
  return truth_of("rate_random_walk", "summed_steps", {k, "mdps/sqrt(s)", "K"});
}

Hidden warm_noise(Case& in, bool strong, Random& random) {
  const double per_c =
      random.sign() * (strong ? random.uniform(0.006, 0.012) : random.uniform(0.0022, 0.003));
  in.setting.sensor.white_per_c = per_c;
  Hidden truth = truth_of("noise_temperature_dependence", "exponential",
                          {100.0 * per_c, "%/degC", "growth of sigma per degree"});
  truth.signed_amplitude = true;
  return truth;
}

std::pair<double, double> baseline_range(const Setting& setting) {
  std::pair<double, double> range{1e9, -1e9};
  for (double setpoint_c : setting.plan.setpoints_c) {
    range.first = std::min(range.first, setting.baseline(setpoint_c));
    range.second = std::max(range.second, setting.baseline(setpoint_c));
  }
  return range;
}

Hidden missing(Case& in, bool strong, Random& random) {
  Sensor& sensor = in.setting.sensor;
  sensor.missing_share = strong ? 0.25 : 0.12;
  // Holes must lie where the codes are: take a key that makes enough of them at the first dwell.
  const double center_dps = in.setting.baseline(in.setting.plan.setpoints_c.front());
  do {
    sensor.missing_key = random.below(1'000'000'000);
  } while (share_displaced(sensor, center_dps) < 0.5 * sensor.missing_share);
  const auto [low, high] = baseline_range(in.setting);
  return truth_of(
      "missing_codes", "scattered_holes",
      {share_of_codes_missing(sensor, low - 2.5 * sensor.white_dps, high + 2.5 * sensor.white_dps),
       "share_of_codes", "codes that never appear, within 2.5 sigma of any dwell"});
}

Hidden rails(Case& in, bool strong, Random& random) {
  const Setting& setting = in.setting;
  const auto [low, high] = baseline_range(setting);
  const bool upper = random.chance(0.5);
  const double room =
      setting.sensor.white_dps * (strong ? random.uniform(0.2, 0.8) : random.uniform(1.2, 1.5));
  const double lsb = setting.sensor.lsb_dps;
  const double rail = lsb * std::round((upper ? high + room : low - room) / lsb);
  in.setting.sensor.rails_dps = upper ? std::pair{-1e6, rail} : std::pair{rail, 1e6};
  Hidden truth = truth_of("saturation", upper ? "upper_rail" : "lower_rail",
                          {0.0, "share_of_samples", "samples at the rail that would be beyond it"});
  truth.also.push_back({rail, "dps", "the rail"});
  return truth;
}

Hidden glitches(Case& in, bool strong, Random& random) {
  const double dwell_samples = static_cast<double>(in.setting.samples_per_dwell) *
                               static_cast<double>(in.setting.plan.setpoints_c.size());
  const double p = strong ? random.uniform(1e-3, 3e-3) : std::max(3e-4, 12.0 / dwell_samples);
  in.setting.sensor.glitches =
      Glitches{p, in.setting.sensor.white_dps * random.log_uniform(12.0, 60.0)};
  return truth_of("outlier_glitches", "rare_large_kicks", {p, "share_of_samples", "samples hit"});
}

Hidden sticking(Case& in, bool strong, Random& random) {
  Sensor& sensor = in.setting.sensor;
  sensor.sticking = strong ? Sticking{random.uniform(5e-4, 1e-3), random.uniform(40.0, 80.0)}
                           : Sticking{random.uniform(2e-4, 3e-4), random.uniform(25.0, 35.0)};
  Hidden truth =
      truth_of("stuck_samples", "exponential_runs", {0.0, "share_of_samples", "repeated samples"});
  truth.also.push_back({sensor.sticking->mean_length, "samples", "mean length of a run"});
  return truth;
}

Hidden losses(Case& in, bool strong, Random& random) {
  const double share = strong ? random.uniform(4e-3, 1e-2) : random.uniform(8e-4, 1.5e-3);
  const double burst = random.uniform(2.0, 8.0);
  in.setting.sensor.loss = Loss{share / burst, burst};
  Hidden truth = truth_of("dropped_samples", "bursts", {0.0, "share_of_samples", "samples lost"});
  truth.parameters = {{"mean_burst", burst}};
  return truth;
}

Hidden sensor_offset(Case& in, bool strong, Random& random) {
  const double offset_c =
      random.sign() * (strong ? random.uniform(1.0, 2.0) : random.uniform(0.4, 0.6));
  in.setting.sensor.board_offset_c = offset_c;
  in.setting.sensor.board_gain = random.uniform(-0.001, 0.001);
  Hidden truth = truth_of("board_sensor_offset", "offset_and_a_little_gain",
                          {offset_c, "degC", "board reads too high by"});
  truth.signed_amplitude = true;
  return truth;
}

/// A board loose in its fixture: it creeps, and slips twice.
Hidden tilting(Case& in, bool strong, Random& random) {
  const double end_s = static_cast<double>(in.over.seconds());
  const double creep = random.sign() * random.uniform(0.08, 0.15);
  const double first_s = end_s * random.uniform(0.25, 0.45);
  const double second_s = end_s * random.uniform(0.55, 0.8);
  const double slip = random.uniform(0.15, 0.25);
  in.tilt_rad.resize(in.over.seconds());
  const double g = random.sign() * noisiness(in) *
                   (strong ? random.uniform(0.08, 0.12) : random.uniform(0.035, 0.045));
  if (in.added_dps.empty()) in.added_dps.assign(in.over.seconds(), 0.0);
  for (std::size_t i = 0; i < in.tilt_rad.size(); ++i) {
    const double t_s = static_cast<double>(i);
    in.tilt_rad[i] = creep * std::pow(t_s / end_s, 0.7) + (t_s > first_s ? slip : 0.0) -
                     (t_s > second_s ? 1.6 * slip : 0.0);
    in.added_dps[i] += g * std::sin(in.tilt_rad[i]);
  }
  Hidden truth = truth_of("g_sensitivity", "loose_fixture",
                          {g, "dps/g", "along the axis that tilts into gravity"});
  truth.signed_amplitude = true;
  return truth;
}

struct Kind {
  std::string name;
  Plant plant;
  double white_dps_max;
  double sigma_over_lsb_min;
};

const std::vector<Kind>& kinds() {
  static const std::vector<Kind> all = {{"g_sensitivity", tilting, 0.12, 0.6},
                                        {"board_sensor_offset", sensor_offset, 10.0, 0.45},
                                        {"compressor_vibration", vibration, 0.35, 0.6},
                                        {"mains_hum", hum, 0.35, 0.6},
                                        {"random_telegraph_noise", telegraph, 0.35, 0.6},
                                        {"bias_instability", instability, 0.12, 0.6},
                                        {"rate_random_walk", walk, 0.12, 0.6},
                                        {"noise_temperature_dependence", warm_noise, 10.0, 0.8},
                                        {"missing_codes", missing, 10.0, 1.2},
                                        {"saturation", rails, 10.0, 0.8},
                                        {"outlier_glitches", glitches, 10.0, 0.45},
                                        {"stuck_samples", sticking, 10.0, 0.8},
                                        {"dropped_samples", losses, 10.0, 0.45}};
  return all;
}

const Kind& kind_of(const std::string& name) {
  return *std::find_if(kinds().begin(), kinds().end(),
                       [&](const Kind& k) { return k.name == name; });
}

Case bare(const Wanted& wanted, std::uint64_t seed, Random& random) {
  Case made;
  made.seed = seed;
  made.setting = draw_setting(wanted, random);
  made.chain = made.setting.chain;
  made.over = made.setting.trajectory(made.chain);
  made.flicker_dps = weak_flicker_dps(made.setting, made.over);
  return made;
}

}  // namespace

std::vector<std::string> fast_names() {
  std::vector<std::string> names;
  for (const auto& kind : kinds()) names.push_back(kind.name);
  return names;
}

Case fast_single(const std::string& name, const std::string& level, std::uint64_t seed) {
  Random random(seed);
  const Kind& kind = kind_of(name);
  Wanted wanted;
  wanted.plans = {"up", "up_down", "shuffled", "up_revisit"};
  if (name == "bias_instability" || name == "rate_random_walk")
    wanted.plans = {"up_down", "shuffled"};
  wanted.white_dps_max = kind.white_dps_max;
  wanted.sigma_over_lsb_min = kind.sigma_over_lsb_min;
  wanted.samples_per_dwell_min = 1000;
  wanted.every_column = true;
  Case made = bare(wanted, seed, random);
  made.effects.push_back(kind.plant(made, level == "strong", random));
  made.category = "single";
  made.level = level;
  made.expected_verdict = "explained";
  made.accepted_verdicts = {"explained"};
  return made;
}

Case with_fast(Case slow, const std::string& name, std::uint64_t seed) {
  Random random(seed ^ 0xfa57);
  slow.effects.push_back(kind_of(name).plant(slow, true, random));
  slow.category = "pair";
  slow.level = "strong";
  return slow;
}

Case null_case(std::uint64_t seed, const std::string& plan) {
  Random random(seed);
  Wanted wanted;
  wanted.plans = {plan};
  wanted.sigma_over_lsb_min = 0.4;
  Case made = bare(wanted, seed, random);
  made.category = "null";
  made.expected_verdict = "consistent";
  made.accepted_verdicts = {"consistent"};
  return made;
}

Case tiring_noise_case(std::uint64_t seed) {
  Random random(seed);
  Wanted wanted;
  wanted.plans = {"up_down", "shuffled"};
  wanted.sigma_over_lsb_min = 0.8;
  wanted.samples_per_dwell_min = 1000;
  Case made = bare(wanted, seed, random);
  const double per_h = random.uniform(0.01, 0.025);
  made.setting.sensor.white_per_h = per_h;
  Hidden truth =
      truth_of("unknown", "tiring_noise", {100.0 * per_h, "%/h", "growth of sigma per hour"});
  truth.signed_amplitude = true;
  made.effects.push_back(truth);
  made.category = "outside";
  made.level = "strong";
  made.expected_verdict = "unexplained";
  made.accepted_verdicts = {"unexplained"};
  return made;
}

}  // namespace hidden
