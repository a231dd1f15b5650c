#include <cmath>

#include "compensation/rig/effects/catalogue.h"
#include "compensation/rig/effects/pointwise.h"
#include "compensation/rig/portable_math.h"

namespace gyrocal::rig {
namespace {

/// The grid's frequency as the board's clock counts it.
double seen_hz(double grid_hz, double clock_ppm) { return grid_hz / (1.0 + clock_ppm * 1e-6); }

class Hum final : public SampleChange {
 public:
  struct Wander {
    double rms_hz = 0.0;
    double tau_s = 1.0;
  };
  Hum(double mdps, double f_hz, double second, Wander wander, const StreamKey& key)
      : amplitude_dps_(mdps * dps_per_mdps),
        f_hz_(f_hz),
        second_(second),
        wander_(wander),
        random_(key),
        phase_(random_.uniform()) {}

  void now(const Drivers& drivers) override {
    const double dt_s = started_ ? drivers.t_s - last_s_ : 0.0;
    phase_ += offset_hz_ * dt_s;
    phase_ -= std::floor(phase_);
    if (wander_.rms_hz > 0.0) {
      const double kept = started_ ? portable_exp(-dt_s / wander_.tau_s) : 0.0;
      offset_hz_ =
          offset_hz_ * kept + wander_.rms_hz * std::sqrt(1.0 - kept * kept) * random_.normal();
    }
    last_s_ = drivers.t_s;
    started_ = true;
  }

  void add(std::span<const double> t_s, double, std::span<double> rate_dps) override {
    for (std::size_t i = 0; i < t_s.size(); ++i) {
      const double turns = f_hz_ * t_s[i] + phase_ + offset_hz_ * (t_s[i] - last_s_);
      rate_dps[i] += amplitude_dps_ * portable_sine(turns);
      if (second_ != 0.0) rate_dps[i] += amplitude_dps_ * second_ * portable_sine(2.0 * turns);
    }
  }

 private:
  double amplitude_dps_;
  double f_hz_;
  double second_;
  Wander wander_;
  RandomStream random_;
  double phase_;
  double offset_hz_ = 0.0;
  double last_s_ = 0.0;
  bool started_ = false;
};

std::vector<Parameter> hum_parameters() {
  return {{"a", "mdps", 0.0, 1000.0, 20.0, Spacing::logarithmic, "amplitude at the grid frequency"},
          {"f", "Hz", 45.0, 65.0, 50.0, Spacing::linear, "grid frequency"},
          {"clock", "ppm", -50000.0, 50000.0, 100.0, Spacing::linear,
           "how fast the board's sampling clock runs"},
          {"second", "1", 0.0, 2.0, 0.3, Spacing::linear, "second harmonic over the first"}};
}

std::vector<Line> hum_lines(Values p) {
  const double f_hz = seen_hz(p[1], p[2]);
  const double dps = p[0] * dps_per_mdps;
  return {{f_hz, dps, 0.0}, {2.0 * f_hz, dps * p[3], 0.0}};
}

class Steady final : public Law {
 public:
  Steady() : Law({"steady", "b += A (sin(2 pi f t) + q sin(4 pi f t))", false, hum_parameters()}) {}
  std::vector<Line> lines(Values p, const Drivers&) const override { return hum_lines(p); }
  std::unique_ptr<SampleChange> samples(Values p, const StreamKey& key) const override {
    return std::make_unique<Hum>(p[0], seen_hz(p[1], p[2]), p[3], Hum::Wander{}, key);
  }
};

class Wandering final : public Law {
 public:
  Wandering()
      : Law({"wandering", "as steady, f wanders (Ornstein-Uhlenbeck)", false, with_wander()}) {}
  std::vector<Line> lines(Values p, const Drivers&) const override { return hum_lines(p); }
  std::unique_ptr<SampleChange> samples(Values p, const StreamKey& key) const override {
    const Hum::Wander wander{p[4] * 1e-3, p[5]};
    return std::make_unique<Hum>(p[0], seen_hz(p[1], p[2]), p[3], wander, key);
  }

 private:
  static std::vector<Parameter> with_wander() {
    auto parameters = hum_parameters();
    parameters.push_back({"wander", "mHz", 0.0, 500.0, 20.0, Spacing::logarithmic, "1 sigma of f"});
    parameters.push_back({"tau", "s", 1.0, 36000.0, 300.0, Spacing::logarithmic, "memory of f"});
    return parameters;
  }
};

}  // namespace

Effect mains_hum() {
  return {"mains_hum",
          "Pickup from the supply at the grid's frequency and twice that. Sampled at 50 Hz, a 50 "
          "Hz grid appears at the difference of grid and board clock, as slow wander of minutes; "
          "a 60 Hz grid appears at 10 and 20 Hz. All boards pick up the same phase.",
          Scope::environment,
          spectrum | slow_drift,
          laws<Steady, Wandering>(),
          {{"bias_instability", "some dwells at another sample rate: the alias moves"},
           {"rate_random_walk", "some dwells at another sample rate"},
           {"random_telegraph_noise", "two levels or a sine in the histogram of the slow stream"},
           {"compressor_vibration", "line power against the cooling phases"}}};
}

}  // namespace gyrocal::rig
