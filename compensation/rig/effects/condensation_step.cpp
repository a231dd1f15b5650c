#include <algorithm>

#include "compensation/rig/effects/catalogue.h"
#include "compensation/rig/effects/pointwise.h"
#include "compensation/rig/portable_math.h"

namespace gyrocal::rig {
namespace {

bool wet(const Drivers& now, double dew_c) { return now.board_c < dew_c && dew_c < now.chamber_c; }

/// A film that grows while the board is below the dew point and the air above it, and dries after.
class Film final : public Response {
 public:
  Film(Values p, bool once) : a_(p[0]), dew_c_(p[1]), on_s_(p[2]), off_s_(p[3]), once_(once) {}

  double at(const Drivers& now) override {
    const double dt_s = started_ ? now.t_s - last_s_ : 0.0;
    started_ = true;
    last_s_ = now.t_s;
    const bool grows = wet(now, dew_c_) && !(once_ && spent_);
    if (was_growing_ && !wet(now, dew_c_)) spent_ = true;
    was_growing_ = grows;
    const double target = grows ? 1.0 : 0.0;
    film_ = target + (film_ - target) * portable_exp(-dt_s / (grows ? on_s_ : off_s_));
    return a_ * film_;
  }

 private:
  double a_, dew_c_, on_s_, off_s_;
  bool once_;
  bool started_ = false;
  bool was_growing_ = false;
  bool spent_ = false;  // the chamber's moisture is on the board and then gone
  double last_s_ = 0.0;
  double film_ = 0.0;
};

/// Droplets that need seeds: slow, then fast, then full (logistic growth).
class Droplets final : public Response {
 public:
  explicit Droplets(Values p) : a_(p[0]), dew_c_(p[1]), on_s_(p[2]), off_s_(p[3]) {}

  double at(const Drivers& now) override {
    const double dt_s = started_ ? now.t_s - last_s_ : 0.0;
    started_ = true;
    last_s_ = now.t_s;
    if (wet(now, dew_c_)) {
      const double seeded = std::max(cover_, 0.02);
      const double growth = portable_exp(4.0 * dt_s / on_s_);
      cover_ = seeded * growth / (1.0 + seeded * (growth - 1.0));
    } else {
      cover_ *= portable_exp(-dt_s / off_s_);
    }
    return a_ * cover_;
  }

 private:
  double a_, dew_c_, on_s_, off_s_;
  bool started_ = false;
  double last_s_ = 0.0;
  double cover_ = 0.0;
};

std::vector<Parameter> film_parameters() {
  return {{"a", "dps", -5.0, 5.0, 0.03, Spacing::linear, "drift under a full film"},
          {"t_dew", "degC", -40.0, 40.0, 3.0, Spacing::linear, "dew or frost point of the air"},
          {"tau_on", "s", 5.0, 3600.0, 120.0, Spacing::logarithmic, "growth of the film"},
          {"tau_off", "s", 60.0, 36000.0, 1800.0, Spacing::logarithmic, "drying"}};
}
constexpr std::string_view film_equation =
    "w' = ([T_b < T_dew < T_c] - w)/(tau_on or tau_off), b += A w";

class FilmEachPass final : public Law {
 public:
  FilmEachPass() : Law({"film", film_equation, true, film_parameters()}) {}
  std::unique_ptr<Response> drift(Values p, const CubicBias&) const override {
    return std::make_unique<Film>(p, false);
  }
};

class FilmOnce final : public Law {
 public:
  FilmOnce()
      : Law({"film_once", "as film, but the first pass uses the moisture up", true,
             film_parameters()}) {}
  std::unique_ptr<Response> drift(Values p, const CubicBias&) const override {
    return std::make_unique<Film>(p, true);
  }
};

class Logistic final : public Law {
 public:
  Logistic()
      : Law({"logistic",
             "w' = 4 w (1 - w)/tau_on while T_b < T_dew < T_c, else -w/tau_off; b += A w", true,
             film_parameters()}) {}
  std::unique_ptr<Response> drift(Values p, const CubicBias&) const override {
    return std::make_unique<Droplets>(p);
  }
};

}  // namespace

Effect condensation_step() {
  return {"condensation_step",
          "When the chamber warms, the air passes the dew point while the board is still colder: a "
          "film of water or frost forms, leaks and pulls, then dries. Only on heating passes, in a "
          "band around 0..12 degC, with a fast rise and a slow decay, on all boards at once.",
          Scope::environment,
          slow_drift,
          laws<FilmEachPass, FilmOnce, Logistic>(),
          {{"bias_jump", "whether it dries; the other boards"},
           {"mode_crossing", "the same temperatures while cooling"},
           {"thermal_lag", "a heating pass in dry gas"},
           {"stress_relaxation", "a heating pass in dry gas"}}};
}

}  // namespace gyrocal::rig
