#include <algorithm>

#include "compensation/rig/effects/catalogue.h"
#include "compensation/rig/effects/pointwise.h"

namespace gyrocal::rig {
namespace {

class Chain final : public SampleChange {
 public:
  Chain(Loss loss, const StreamKey& key)
      : begins_(std::min(1.0, loss.share / ((1.0 - loss.share) * loss.mean_burst))),
        ends_(1.0 / loss.mean_burst),
        random_(key) {}
  void lose(std::span<std::uint8_t> lost) override {
    for (auto& one : lost) {
      const double u = random_.uniform();
      losing_ = losing_ ? u >= ends_ : u < begins_;
      if (losing_) one = 1;
    }
  }

 private:
  double begins_;
  double ends_;
  RandomStream random_;
  bool losing_ = false;
};

Parameter share() {
  return {"share", "1", 0.0, 0.5, 1e-3, Spacing::logarithmic, "of frames that never arrive"};
}

class Independent final : public Law {
 public:
  Independent()
      : Law({"independent", "each frame is lost with the same probability", false, {share()}}) {}
  Loss loss(Values p) const override { return {p[0], 1.0 / (1.0 - p[0])}; }
  std::unique_ptr<SampleChange> samples(Values p, const StreamKey& key) const override {
    return std::make_unique<Chain>(loss(p), key);
  }
};

class Bursts final : public Law {
 public:
  Bursts()
      : Law({"bursts",
             "Gilbert-Elliott: good and bad states, all frames lost in the bad",
             false,
             {share(),
              {"length", "frames", 1.0, 10000.0, 10.0, Spacing::logarithmic, "mean burst"}}}) {}
  Loss loss(Values p) const override { return {p[0], p[1]}; }
  std::unique_ptr<SampleChange> samples(Values p, const StreamKey& key) const override {
    return std::make_unique<Chain>(loss(p), key);
  }
};

}  // namespace

Effect dropped_samples() {
  return {"dropped_samples",
          "Frames get lost on the way: singly, or in bursts while host or bus is busy. The board's "
          "counter goes on and shows the gap; lines in the spectrum slip in phase, dwells end "
          "short.",
          Scope::board,
          link,
          laws<Bursts, Independent>(),
          {{"stuck_samples", "the counter"}}};
}

}  // namespace gyrocal::rig
