#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "compensation/rig/random.h"
#include "compensation/rig/rig_model.h"
#include "compensation/values/error.h"

/// What an effect is: one object that both generates (the simulated boards) and predicts
/// (diagnosis), so that what is found is what would have been made. One file an effect in this
/// folder; effects/catalogue.h lists them.
///
/// Predicting a drift over a record, with unit amplitude and trial shapes:
///
///   const Effect& effect = *find_effect("thermal_hysteresis");
///   const Law& law = *effect.laws[0];                   // "play"
///   std::vector<double> p = usual_values(law);          // p[0] is always the amplitude
///   p[0] = 1.0; p[1] = 2.5;                             // h = 1 deg/s, w = 2.5 degC
///   std::vector<double> dps = drift_over(law, p, bias, drivers);
///
/// Where law.info.linear, the drift at amplitude a is a times that at 1. Where it is not
/// (thermal_lag in s, self_heating in degC), the amplitude is one more shape parameter.
namespace gyrocal::rig {

/// All that an effect may depend on, at one instant. Temperatures are physical (continuous): a
/// predictor fills board and die from the chamber's record through the lags
/// (compensation/rig/driver_track.h), never by differencing a coarse sensor.
struct Drivers {
  double t_s = 0.0;     ///< campaign time
  double t_on_s = 0.0;  ///< since the board's power-on
  double setpoint_c = 20.0;
  double chamber_c = 20.0;
  double chamber_rate_c_per_min = 0.0;  ///< negative: the compressor cools
  double board_c = 20.0;
  double die_c = 20.0;
  double die_rate_c_per_min = 0.0;
  std::array<double, 3> acc_g{0.0, 0.0, 1.0};  ///< tilts of the rig's effects included
};

enum class Spacing { linear, logarithmic };

/// One number of a law. Values outside [low, high] are refused in a rig model.
struct Parameter {
  std::string_view name;
  std::string_view unit;
  double low;
  double high;
  double usual;     ///< default
  Spacing spacing;  ///< how a scan over it should be spaced
  std::string_view meaning;
};

/// Values of a law's parameters in the order of LawInfo::parameters; [0] is the amplitude.
using Values = std::span<const double>;

/// Something that answers with one number at each instant and remembers what came before: drift
/// [deg/s] or the board sensor's error [degC]. Instants are given in time order; the first starts
/// it in equilibrium. Steps may be of any length: lags are exact for inputs straight in between.
class Response {
 public:
  virtual ~Response() = default;
  virtual double at(const Drivers& now) = 0;
};

/// One Ornstein-Uhlenbeck process of a stochastic drift; tau_s = infinity is a random walk that
/// starts at 0. Independent terms add up.
struct OuTerm {
  double tau_s;
  double variance_dps2;          ///< stationary; 0 for a random walk
  double walk_dps2_per_s = 0.0;  ///< variance growth of a random walk
};
/// Two-sided spectral density [deg^2/s^2/Hz] at f_hz > 0 (IEEE 952's convention: flicker is
/// B^2/(2 pi f), a random walk K^2/(2 pi f)^2).
[[nodiscard]] double spectral_density(const OuTerm& term, double f_hz);

/// Two-level switching: +-level/2 around the mean of the levels.
struct Telegraph {
  double level_dps;    ///< distance of the levels
  double low_dwell_s;  ///< mean time in the low level at this temperature
  double high_dwell_s;
};
/// Its two-sided Lorentzian at f_hz > 0.
[[nodiscard]] double spectral_density(const Telegraph& telegraph, double f_hz);

/// A line in the samples, at its true frequency; alias_hz says where it appears.
struct Line {
  double f_hz;
  double amplitude_dps;
  double acc_g;  ///< amplitude of the same line in the accelerometer
};
[[nodiscard]] double alias_hz(double f_hz, double sample_rate_hz);

/// Loss of frames, a two-state (Gilbert-Elliott) chain: in the bad state every frame is lost.
struct Loss {
  double share;       ///< of all frames
  double mean_burst;  ///< mean frames lost in a row; 1/(1-share) is independent loss
};

/// What happens to single samples of one axis, in order. One object per board and axis; effects of
/// wider scope get the same random stream on each and so do the same everywhere.
class SampleChange {
 public:
  virtual ~SampleChange() = default;
  /// Physics has moved on (every 0.2 s of campaign time, before the samples from there on).
  virtual void now(const Drivers&) {}
  /// Adds to the rate before the ADC. sigma_dps is the white noise per sample now.
  virtual void add(std::span<const double> /*t_s*/, double /*sigma_dps*/,
                   std::span<double> /*rate_dps*/) {}
  /// Changes the codes after the ADC (whole numbers).
  virtual void change(std::span<double> /*codes*/) {}
  /// Sets lost[i] for frames that never arrive; others are left alone.
  virtual void lose(std::span<std::uint8_t> /*lost*/) {}
};

struct LawInfo {
  std::string_view name;
  std::string_view equation;
  bool linear;  ///< drift (or the sensor's error) is proportional to parameter 0
  std::vector<Parameter> parameters;
};

/// One mathematical form of an effect. A law overrides what it touches; the rest says "nothing".
class Law {
 public:
  explicit Law(LawInfo law_info) : info(std::move(law_info)) {}
  virtual ~Law() = default;
  Law(const Law&) = delete;
  Law& operator=(const Law&) = delete;

  const LawInfo info;

  /// Deterministic drift [deg/s]; nullptr: none. `bias` is the baseline of the axis.
  [[nodiscard]] virtual std::unique_ptr<Response> drift(Values, const CubicBias& bias) const;
  /// Error of the board's temperature sensor [degC]; nullptr: none.
  [[nodiscard]] virtual std::unique_ptr<Response> board_reading(Values) const;
  /// Stochastic drift as a sum of independent terms; empty: none.
  [[nodiscard]] virtual std::vector<OuTerm> stochastic(Values) const;
  /// level_dps == 0: none.
  [[nodiscard]] virtual Telegraph telegraph(Values, const Drivers&) const;
  /// Lines present at this instant.
  [[nodiscard]] virtual std::vector<Line> lines(Values, const Drivers&) const;
  /// Factor on the white noise's standard deviation; 1: none.
  [[nodiscard]] virtual double noise_factor(Values, const Drivers&) const;
  /// What is added to the specific force [g]; zero: none.
  [[nodiscard]] virtual std::array<double, 3> tilt_g(Values, const Drivers&) const;
  /// The code [LSB, whole] that comes out where the ADC had `exact_lsb` and would give `code`.
  [[nodiscard]] virtual double code(Values, double exact_lsb, double code, double lsb_dps) const;
  /// share == 0: none.
  [[nodiscard]] virtual Loss loss(Values) const;
  /// Generator of what happens to samples (lines, telegraph, glitches, stuck, lost); nullptr: none.
  [[nodiscard]] virtual std::unique_ptr<SampleChange> samples(Values, const StreamKey&) const;
};

/// Who feels one and the same instance.
enum class Scope {
  axis,         ///< each axis of each board for itself
  board,        ///< all axes of a board alike
  environment,  ///< all boards of the chamber alike
};

/// In what an effect shows.
enum Channel : unsigned {
  slow_drift = 1u,         ///< the monitor stream
  board_temperature = 2u,  ///< the board's sensor against the chamber
  spectrum = 4u,
  distribution = 8u,  ///< codes, spread, tails, runs
  link = 16u,
  acceleration = 32u,
};

struct Confusion {
  std::string_view effect;
  std::string_view tell_apart;  ///< the observation that would separate them
};

struct Effect {
  std::string_view name;  ///< of DESIGN section 10
  std::string_view physics;
  Scope scope;
  unsigned channels;                             ///< Channel bits
  std::vector<std::unique_ptr<const Law>> laws;  ///< the usual one first
  std::vector<Confusion> confused_with;
};

/// Default values of all parameters.
[[nodiscard]] std::vector<double> usual_values(const Law& law);

/// A law's drift over a whole record: one value per instant [deg/s]; zeros if it has none.
[[nodiscard]] std::vector<double> drift_over(const Law& law, Values values, const CubicBias& bias,
                                             std::span<const Drivers> record);

/// An EffectUse with its names looked up and its values complete and in range.
struct Instance {
  const Effect* effect;
  const Law* law;
  std::vector<double> values;
  std::array<bool, 3> axes;
  std::vector<std::uint32_t> boards;
};
/// `use` with its law and all parameters spelled out, in the law's order. `use` must be valid.
[[nodiscard]] EffectUse completed(const EffectUse& use);

/// unknown_name (lists what is known), out_of_range, not_finite. An empty law is the first one.
[[nodiscard]] Result<Instance> instantiate(const EffectUse& use);
[[nodiscard]] Result<std::vector<Instance>> instantiate(const RigModel& model);

}  // namespace gyrocal::rig
