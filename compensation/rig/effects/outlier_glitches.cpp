#include "compensation/rig/effects/catalogue.h"
#include "compensation/rig/effects/pointwise.h"

namespace gyrocal::rig {
namespace {

class Glitches final : public SampleChange {
 public:
  Glitches(Values p, bool both_signs, const StreamKey& key)
      : p_(p[0]), size_(p[1]), both_signs_(both_signs), random_(key) {}
  void add(std::span<const double> t_s, double sigma_dps, std::span<double> rate_dps) override {
    for (std::size_t i = 0; i < t_s.size(); ++i) {
      if (random_.uniform() >= p_) continue;
      const double height = size_ * sigma_dps * (0.5 + random_.uniform());
      const bool down = both_signs_ && random_.uniform() < 0.5;
      rate_dps[i] += down ? -height : height;
    }
  }

 private:
  double p_;
  double size_;
  bool both_signs_;
  RandomStream random_;
};

std::vector<Parameter> glitch_parameters() {
  return {{"p", "1", 0.0, 0.5, 1e-3, Spacing::logarithmic, "probability per sample"},
          {"size", "sigma", 1.0, 5000.0, 30.0, Spacing::logarithmic,
           "mean height over the white noise; spread from half to one and a half"}};
}

class Symmetric final : public Law {
 public:
  Symmetric()
      : Law({"symmetric", "with probability p: y += +-size sigma (0.5..1.5)", false,
             glitch_parameters()}) {}
  std::unique_ptr<SampleChange> samples(Values p, const StreamKey& key) const override {
    return std::make_unique<Glitches>(p, true, key);
  }
};

class OneSided final : public Law {
 public:
  OneSided()
      : Law({"one_sided", "with probability p: y += size sigma (0.5..1.5)", false,
             glitch_parameters()}) {}
  std::unique_ptr<SampleChange> samples(Values p, const StreamKey& key) const override {
    return std::make_unique<Glitches>(p, false, key);
  }
};

}  // namespace

Effect outlier_glitches() {
  return {"outlier_glitches",
          "A discharge, a supply spike or a converter fault throws single samples far off. They "
          "stand alone, at random times, ten to a thousand sigma away; mean and spread of a dwell "
          "suffer, neighbours do not.",
          Scope::axis,
          distribution,
          laws<Symmetric, OneSided>(),
          {{"random_telegraph_noise", "whether the level lasts for more than one sample"},
           {"noise_temperature_dependence", "tails or the whole width"}}};
}

}  // namespace gyrocal::rig
