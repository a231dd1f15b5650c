#include <algorithm>

#include "compensation/rig/effects/catalogue.h"
#include "compensation/rig/effects/pointwise.h"

namespace gyrocal::rig {
namespace {

/// The play operator of radius w: follows the input when pushed by more than w.
class Play {
 public:
  explicit Play(double w_c) : w_c_(w_c) {}
  /// (T - play)/w, in [-1, 1]; starts at 0.
  double push(double die_c) {
    if (!started_) center_c_ = die_c;
    started_ = true;
    center_c_ = std::clamp(center_c_, die_c - w_c_, die_c + w_c_);
    return (die_c - center_c_) / w_c_;
  }

 private:
  double w_c_;
  double center_c_ = 0.0;
  bool started_ = false;
};

Parameter height() {
  return {"h",
          "dps",
          -2.0,
          2.0,
          0.02,
          Spacing::linear,
          "each branch lies h off the middle: heating +h, cooling -h, 2h apart"};
}
Parameter width(std::string_view name, double usual) {
  return {name,
          "degC",
          0.1,
          40.0,
          usual,
          Spacing::logarithmic,
          "a reversal by w is forgotten, by 2w it has changed the branch"};
}

class PlayLaw final : public Law {
 public:
  PlayLaw() : Law({"play", "b += h (T - play_w[T])/w", true, {height(), width("w", 2.5)}}) {}
  std::unique_ptr<Response> drift(Values p, const CubicBias&) const override {
    return pointwise([h = p[0], play = Play(p[1])](const Drivers& now) mutable {
      return h * play.push(now.die_c);
    });
  }
};

class PlayPair final : public Law {
 public:
  PlayPair()
      : Law({"play_pair",
             "b += h/2 (T - play_w1[T])/w1 + h/2 (T - play_w2[T])/w2",
             true,
             {height(), width("w1", 1.0), width("w2", 6.0)}}) {}
  std::unique_ptr<Response> drift(Values p, const CubicBias&) const override {
    return pointwise(
        [h = p[0], narrow = Play(p[1]), wide = Play(p[2])](const Drivers& now) mutable {
          const double first = narrow.push(now.die_c);
          return 0.5 * h * (first + wide.push(now.die_c));
        });
  }
};

class Relay final : public Law {
 public:
  Relay()
      : Law({"relay",
             "b += h R, R = +1 above T0 + w, -1 below T0 - w, kept in between",
             true,
             {height(),
              {"t0", "degC", -60.0, 130.0, 20.0, Spacing::linear, "middle of the loop"},
              width("w", 3.0)}}) {}
  std::unique_ptr<Response> drift(Values p, const CubicBias&) const override {
    return pointwise([h = p[0], t0 = p[1], w = p[2], state = 0.0](const Drivers& now) mutable {
      if (state == 0.0) state = now.die_c >= t0 ? 1.0 : -1.0;
      if (now.die_c > t0 + w) state = 1.0;
      if (now.die_c < t0 - w) state = -1.0;
      return h * state;
    });
  }
};

class Direction final : public Law {
 public:
  Direction()
      : Law({"direction",
             "b += h sign(last movement of more than d)",
             true,
             {height(),
              {"d", "degC", 0.05, 10.0, 0.6, Spacing::logarithmic,
               "what counts as a reversal; below it the chamber's cycling would"}}}) {}
  std::unique_ptr<Response> drift(Values p, const CubicBias&) const override {
    // A play of radius d/2 whose centre moves only when the direction is sure.
    return pointwise([h = p[0], play = Play(0.5 * p[1]), sign = 0.0](const Drivers& now) mutable {
      const double push = play.push(now.die_c);
      if (push >= 1.0 - 1e-9) sign = 1.0;
      if (push <= -1.0 + 1e-9) sign = -1.0;
      return h * sign;
    });
  }
};

}  // namespace

Effect thermal_hysteresis() {
  return {"thermal_hysteresis",
          "Die attach, solder and mould compound yield a little on every stroke. At the same "
          "temperature the bias depends on the direction it was reached from, not on the rate; "
          "only turning points are remembered.",
          Scope::axis,
          slow_drift,
          laws<PlayLaw, PlayPair, Relay, Direction>(),
          {{"stress_relaxation", "a doubled soak: hysteresis stays, relaxation decays"},
           {"bias_jump", "the same setpoints in the other direction, twice"},
           {"aging_drift", "a third pass in the first direction"}}};
}

}  // namespace gyrocal::rig
