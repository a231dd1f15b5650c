#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "tests/hidden_effects/slow_laws.h"

using hidden::Random;
using hidden::Series;
using hidden::Trajectory;

namespace {

/// Straight up and down again between two temperatures, all nodes together.
Trajectory triangle(double low_c, double high_c, double rate_c_per_s) {
  Trajectory over;
  const auto half = static_cast<std::size_t>((high_c - low_c) / rate_c_per_s);
  for (std::size_t i = 0; i <= 2 * half; ++i) {
    const double up = i <= half ? static_cast<double>(i) : static_cast<double>(2 * half - i);
    const double at_c = low_c + up * rate_c_per_s;
    over.die_c.push_back(at_c);
    over.rate_c_per_min.push_back(60.0 * (i < half ? rate_c_per_s : -rate_c_per_s));
    over.board_c.push_back(at_c - (i < half ? 1.0 : -1.0));
    over.air_c.push_back(at_c);
  }
  over.felt_c = over.die_c;
  over.setpoint_c = over.die_c;
  return over;
}

double swing(const Series& series) {
  const auto [low, high] = std::minmax_element(series.begin(), series.end());
  return *high - *low;
}

}  // namespace

TEST_CASE("each hysteresis has branches its amplitude above and below the middle, rate or no rate") {
  const auto form =
      GENERATE(std::string("bouc_wen"), std::string("preisach"), std::string("play_spectrum"));
  const auto seed = GENERATE(range(0u, 5u));
  CAPTURE(form, seed);
  for (double rate : {0.01, 0.02}) {
    const Trajectory over = triangle(-15.0, 55.0, rate);
    Random random(seed);
    const auto law = hidden::draw_law("thermal_hysteresis", form, over, random);
    const Series shape = law.shape(over);
    const std::size_t quarter = over.seconds() / 4;  // at 20 degC both ways, far from the turns
    const double gap = shape[quarter] - shape[over.seconds() - 1 - quarter];
    CHECK(gap == Approx(2.0).margin(form == "preisach" ? 0.24 : 0.04));
  }
}

TEST_CASE("a Fano crossing swings by its amplitude and repeats on the way back") {
  const auto seed = GENERATE(range(0u, 20u));
  CAPTURE(seed);
  const Trajectory over = triangle(-60.0, 100.0, 0.01);
  Random random(seed);
  const Series shape = hidden::draw_law("mode_crossing", "fano", over, random).shape(over);
  CHECK(swing(shape) == Approx(1.0).margin(0.005));
  CHECK(shape[3000] == Approx(shape[over.seconds() - 1 - 3000]).margin(1e-9));
}

TEST_CASE("stress relaxation answers a sudden degree with its amplitude and then forgets it") {
  const auto form = GENERATE(std::string("stretched"), std::string("two_glues"));
  Trajectory over;
  over.die_c.assign(100000, 21.0);
  over.die_c.front() = 20.0;
  over.air_c = over.die_c;
  Random random(2);
  const Series shape = hidden::draw_law("stress_relaxation", form, over, random).shape(over);
  CHECK(shape[1] == Approx(1e-3).epsilon(0.01));
  CHECK(std::abs(shape.back()) < 1e-4);
}

TEST_CASE("a film grows on heating through the dew point only, to a whole film, and dries") {
  const Trajectory over = triangle(-15.0, 55.0, 0.012);
  Random random(6);
  const auto law = hidden::draw_law("condensation_step", "logistic_film", over, random);
  const Series film = law.shape(over);
  CHECK(*std::max_element(film.begin(), film.end()) < 1.0 + 1e-12);
  CHECK(*std::max_element(film.begin(),
                          film.begin() + static_cast<std::ptrdiff_t>(over.seconds() / 2)) > 0.3);
  CHECK(*std::max_element(film.begin() + static_cast<std::ptrdiff_t>(over.seconds() * 3 / 4),
                          film.end()) < 0.01);
}

TEST_CASE("aging of one millidegree an hour ends where the hours say, whatever its form") {
  const auto form = GENERATE(std::string("logarithmic"), std::string("power"));
  Trajectory over;
  over.air_c.assign(36001, 20.0);
  over.die_c = over.air_c;
  Random random(8);
  const Series shape = hidden::draw_law("aging_drift", form, over, random).shape(over);
  CHECK(shape.front() == 0.0);
  CHECK(shape.back() == Approx(10e-3).epsilon(1e-3));
}

TEST_CASE("a heating rate of one degree a minute gives the amplitude, nearly") {
  const Trajectory over = triangle(0.0, 40.0, 1.0 / 60.0);
  Random random(1);
  const Series shape =
      hidden::draw_law("temperature_rate", "saturating_gradient", over, random).shape(over);
  CHECK(shape[1000] == Approx(1.0).margin(0.05));
  CHECK(shape.back() == Approx(-1.0).margin(0.05));
}

TEST_CASE("every law and every outsider has a shape or heats, and stays finite") {
  const Trajectory over = triangle(-10.0, 50.0, 0.01);
  for (const std::string name :
       {"temperature_rate", "thermal_lag", "thermal_hysteresis", "self_heating", "aging_drift",
        "bias_jump", "mode_crossing", "condensation_step", "stress_relaxation", "unknown"}) {
    for (const auto& form : hidden::laws_of(name)) {
      Random random(12);
      const auto law = name == "unknown" ? hidden::draw_outsider(form, over, random)
                                         : hidden::draw_law(name, form, over, random);
      INFO(name << " " << form);
      REQUIRE(law.name == name);
      CHECK(static_cast<bool>(law.shape) != static_cast<bool>(law.heat));
      if (!law.shape) continue;
      const Series shape = law.shape(over);
      CHECK(shape.size() == over.seconds());
      CHECK(std::all_of(shape.begin(), shape.end(), [](double v) { return std::isfinite(v); }));
      CHECK(std::any_of(shape.begin(), shape.end(), [](double v) { return v != 0.0; }));
    }
  }
}
