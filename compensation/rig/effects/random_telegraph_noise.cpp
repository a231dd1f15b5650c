#include "compensation/rig/effects/catalogue.h"
#include "compensation/rig/effects/pointwise.h"
#include "compensation/rig/portable_math.h"

namespace gyrocal::rig {
namespace {

/// Dwell times follow Arrhenius' law around the temperature they are given for.
double hotter(double activation_ev, double die_c) {
  constexpr double boltzmann_ev_per_k = 8.617333262e-5;
  constexpr double reference_k = 293.15;
  const double inverse = 1.0 / (die_c + 273.15) - 1.0 / reference_k;
  return portable_exp(-activation_ev / boltzmann_ev_per_k * inverse);
}

class Switching final : public SampleChange {
 public:
  Switching(Values p, const StreamKey& key)
      : half_dps_(0.5 * p[0] * dps_per_mdps),
        low_s_(p[1]),
        high_s_(p[2]),
        activation_ev_(p[3]),
        random_(key) {}

  void now(const Drivers& drivers) override {
    const double speed = hotter(activation_ev_, drivers.die_c);
    rate_per_s_ = speed * (1.0 / low_s_ + 1.0 / high_s_);
    step_s_ = -1.0;
  }

  void add(std::span<const double> t_s, double, std::span<double> rate_dps) override {
    const double share_high = high_s_ / (low_s_ + high_s_);
    for (std::size_t i = 0; i < t_s.size(); ++i) {
      const double dt_s = t_s[i] - last_s_;
      last_s_ = t_s[i];
      if (dt_s != step_s_) {
        step_s_ = dt_s;
        forgets_ = started_ ? 1.0 - portable_exp(-rate_per_s_ * dt_s) : 1.0;
      }
      // With probability `forgets_` the level is drawn anew from the stationary law.
      const double u = random_.uniform();
      if (u < forgets_) high_ = u < forgets_ * share_high;
      started_ = true;
      rate_dps[i] += high_ ? half_dps_ : -half_dps_;
    }
  }

 private:
  double half_dps_, low_s_, high_s_, activation_ev_;
  RandomStream random_;
  double rate_per_s_ = 1.0;
  double step_s_ = -1.0;
  double forgets_ = 1.0;
  double last_s_ = 0.0;
  bool started_ = false;
  bool high_ = false;
};

class TwoLevels final : public Law {
 public:
  TwoLevels()
      : Law({"two_levels",
             "b jumps between -A/2 and +A/2; mean times in each at 20 degC",
             false,
             {{"a", "mdps", 0.0, 10000.0, 50.0, Spacing::logarithmic, "distance of the levels"},
              {"low", "s", 0.005, 36000.0, 2.0, Spacing::logarithmic, "mean time in the low level"},
              {"high", "s", 0.005, 36000.0, 2.0, Spacing::logarithmic,
               "mean time in the high level"},
              {"ea", "eV", 0.0, 1.5, 0.0, Spacing::linear,
               "activation energy: rates rise with temperature"}}}) {}
  Telegraph telegraph(Values p, const Drivers& now) const override {
    const double speed = hotter(p[3], now.die_c);
    return {p[0] * dps_per_mdps, p[1] / speed, p[2] / speed};
  }
  std::unique_ptr<SampleChange> samples(Values p, const StreamKey& key) const override {
    return std::make_unique<Switching>(p, key);
  }
};

}  // namespace

Effect random_telegraph_noise() {
  return {"random_telegraph_noise",
          "One trap or one bad contact switches between two states at random. The rate has two "
          "levels and a Lorentzian spectrum; how long it stays in each follows temperature by "
          "Arrhenius' law.",
          Scope::axis,
          slow_drift | spectrum | distribution,
          laws<TwoLevels>(),
          {{"bias_instability", "two levels in the histogram; a hidden Markov model"},
           {"bias_jump", "longer watching: the old level comes back"},
           {"outlier_glitches", "a faster sample rate: telegraph levels last"}}};
}

}  // namespace gyrocal::rig
