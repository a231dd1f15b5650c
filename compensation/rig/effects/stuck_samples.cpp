#include <algorithm>

#include "compensation/rig/effects/catalogue.h"
#include "compensation/rig/effects/pointwise.h"

namespace gyrocal::rig {
namespace {

class Repeats final : public SampleChange {
 public:
  Repeats(double share, double length, const StreamKey& key)
      : begins_(share / ((1.0 - share) * length)), ends_(1.0 / length), random_(key) {}
  void change(std::span<double> codes) override {
    for (double& code : codes) {
      const double u = random_.uniform();
      stuck_ = started_ && (stuck_ ? u >= ends_ : u < begins_);
      started_ = true;
      if (stuck_) code = held_;
      held_ = code;
    }
  }

 private:
  double begins_;
  double ends_;
  RandomStream random_;
  double held_ = 0.0;
  bool stuck_ = false;
  bool started_ = false;
};

class Runs final : public Law {
 public:
  Runs()
      : Law({"runs",
             "runs of repeated samples, lengths geometric",
             false,
             {{"share", "1", 0.0, 0.9, 0.002, Spacing::logarithmic, "of samples that repeat"},
              {"length", "samples", 1.0, 5000.0, 50.0, Spacing::logarithmic,
               "mean repeats in a run"}}}) {}
  std::unique_ptr<SampleChange> samples(Values p, const StreamKey& key) const override {
    return std::make_unique<Repeats>(p[0], p[1], key);
  }
};

}  // namespace

Effect stuck_samples() {
  return {"stuck_samples",
          "Sensor or firmware hands out the last value again: runs of equal codes on all axes at "
          "once while the counter goes on, far longer than coarse rounding would give.",
          Scope::board,
          distribution,
          laws<Runs>(),
          {{"saturation", "whether runs sit at the end code"},
           {"dropped_samples", "the counter"},
           {"missing_codes", "the run lengths that rounding alone would give"}}};
}

}  // namespace gyrocal::rig
