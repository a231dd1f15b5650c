#include "compensation/rig/effects/catalogue.h"
#include "compensation/rig/effects/pointwise.h"
#include "compensation/rig/portable_math.h"

namespace gyrocal::rig {
namespace {

/// The compressor runs while the air is being cooled; its own state is in no known register.
bool running(const Drivers& now) { return now.chamber_rate_c_per_min < 0.0; }

std::unique_ptr<Response> step_while_running(double mdps) {
  return pointwise(
      [dps = mdps * dps_per_mdps](const Drivers& now) { return running(now) ? dps : 0.0; });
}

class GatedLine final : public SampleChange {
 public:
  GatedLine(double mdps, double f_hz, const StreamKey& key)
      : amplitude_dps_(mdps * dps_per_mdps), f_hz_(f_hz), phase_(RandomStream(key).uniform()) {}
  void now(const Drivers& drivers) override { running_ = running(drivers); }
  void add(std::span<const double> t_s, double, std::span<double> rate_dps) override {
    if (!running_) return;
    for (std::size_t i = 0; i < t_s.size(); ++i) {
      rate_dps[i] += amplitude_dps_ * portable_sine(f_hz_ * t_s[i] + phase_);
    }
  }

 private:
  double amplitude_dps_;
  double f_hz_;
  double phase_;
  bool running_ = false;
};

Parameter line_amplitude() {
  return {"a", "mdps", 0.0, 1000.0, 20.0, Spacing::logarithmic, "of the line while it runs"};
}
Parameter rotor() {
  return {"f", "Hz", 1.0, 500.0, 24.5, Spacing::linear, "rotor: 24..25, 29, 48..49 or 58 Hz"};
}
Parameter shaking() {
  return {"acc", "mg", 0.0, 500.0, 5.0, Spacing::logarithmic, "the line in the accelerometer"};
}
Parameter rectified(double low) {
  return {"v", "mdps", low, 500.0, 5.0, Spacing::linear, "vibration rectified to a step"};
}

std::vector<Line> line_while_running(const Drivers& now, double mdps, double f_hz, double mg) {
  if (!running(now)) return {};
  return {{f_hz, mdps * dps_per_mdps, mg * 1e-3}};
}

class LineAndStep final : public Law {
 public:
  LineAndStep()
      : Law({"line_and_step",
             "b += A sin(2 pi f t) + V while the compressor runs",
             false,
             {line_amplitude(), rotor(), rectified(-500.0), shaking()}}) {}
  std::unique_ptr<Response> drift(Values p, const CubicBias&) const override {
    return step_while_running(p[2]);
  }
  std::vector<Line> lines(Values p, const Drivers& now) const override {
    return line_while_running(now, p[0], p[1], p[3]);
  }
  std::unique_ptr<SampleChange> samples(Values p, const StreamKey& key) const override {
    return std::make_unique<GatedLine>(p[0], p[1], key);
  }
};

class LineOnly final : public Law {
 public:
  LineOnly()
      : Law({"line",
             "b += A sin(2 pi f t) while the compressor runs",
             false,
             {line_amplitude(), rotor(), shaking()}}) {}
  std::vector<Line> lines(Values p, const Drivers& now) const override {
    return line_while_running(now, p[0], p[1], p[2]);
  }
  std::unique_ptr<SampleChange> samples(Values p, const StreamKey& key) const override {
    return std::make_unique<GatedLine>(p[0], p[1], key);
  }
};

class StepOnly final : public Law {
 public:
  StepOnly() : Law({"step", "b += V while the compressor runs", true, {rectified(-500.0)}}) {}
  std::unique_ptr<Response> drift(Values p, const CubicBias&) const override {
    return step_while_running(p[0]);
  }
};

}  // namespace

Effect compressor_vibration() {
  return {
      "compressor_vibration",
      "The chamber's compressor shakes the board at its rotor's frequency: a line at its alias "
      "through g-sensitivity, and a step because vibration is rectified. Both only while it "
      "runs, that is while the air is being cooled, and in the accelerometer too.",
      Scope::environment,
      slow_drift | spectrum | acceleration,
      laws<LineAndStep, LineOnly, StepOnly>(),
      {{"temperature_rate", "one dwell with the compressor stopped"},
       {"mains_hum", "line power against the cooling phases; slip of the frequency with load"}}};
}

}  // namespace gyrocal::rig
