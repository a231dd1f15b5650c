#include <catch2/catch.hpp>
#include <cmath>

#include "compensation/rig/portable_math.h"
#include "tests/compensation/rig/rig_fixture.h"

using namespace gyrocal;
using namespace gyrocal::rig;

namespace {

const CubicBias z = Baseline{}.bias[2];

/// Rows of dt_s whose die temperature is given; the rate is what it makes of itself.
std::vector<Drivers> record(const std::vector<double>& die_c, double dt_s = 10.0) {
  std::vector<Drivers> rows(die_c.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    rows[i].t_s = rows[i].t_on_s = dt_s * static_cast<double>(i);
    rows[i].die_c = rows[i].board_c = rows[i].chamber_c = die_c[i];
    if (i > 0) rows[i].die_rate_c_per_min = (die_c[i] - die_c[i - 1]) / dt_s * 60.0;
  }
  return rows;
}

/// From one temperature to the next in steps of 0.1 degC.
std::vector<double> path(const std::vector<double>& corners) {
  std::vector<double> made{corners.front()};
  for (std::size_t i = 1; i < corners.size(); ++i) {
    const int steps = static_cast<int>(std::lround(std::abs(corners[i] - corners[i - 1]) * 10.0));
    const double from = corners[i - 1];
    for (int k = 1; k <= steps; ++k) made.push_back(from + (corners[i] - from) * k / steps);
  }
  return made;
}

std::vector<double> drift(const std::string& effect, const std::string& law, Values values,
                          const std::vector<Drivers>& rows) {
  return drift_over(law_of(effect, law), values, z, rows);
}

}  // namespace

TEST_CASE("temperature_rate follows the rate's sign and vanishes at rest") {
  std::vector<double> die = path({0.0, 10.0, 0.0});
  die.resize(300, 0.0);
  const auto dps =
      drift("temperature_rate", "proportional", std::vector<double>{0.02}, record(die));
  CHECK(dps[50] == Approx(0.02 * 0.6));
  CHECK(dps[150] == Approx(-0.02 * 0.6));
  CHECK(dps[299] == 0.0);
}

TEST_CASE("thermal_lag is -tau b' r on a ramp and nothing where the bias is flat") {
  const auto rows = record(path({-10.0, 50.0}), 6.0);  // 1 degC/min
  const auto dps = drift("thermal_lag", "pole", std::vector<double>{60.0}, rows);
  const auto cascade = drift("thermal_lag", "cascade", std::vector<double>{60.0}, rows);
  const auto lead = drift("thermal_lag", "lead", std::vector<double>{60.0}, rows);
  for (std::size_t i = 100; i < rows.size(); i += 50) {
    CAPTURE(rows[i].die_c);
    const double first_order = -z.slope(rows[i].die_c - 0.5);  // 60 s at 1 degC/min
    CHECK(dps[i] == Approx(first_order).margin(1e-4));
    CHECK(cascade[i] == Approx(first_order).margin(1e-4));
    CHECK(lead[i] == Approx(z.slope(rows[i].die_c + 0.5)).margin(1e-4));
  }
}

TEST_CASE("hysteresis: branches 2h apart, whatever the speed; only turning points count") {
  const std::vector<double> loop = path({20.0, 40.0, 0.0, 40.0});
  for (const std::string law : {"play", "play_pair", "direction"}) {
    CAPTURE(law);
    auto values = usual_values(law_of("thermal_hysteresis", law));
    const auto slow = drift("thermal_hysteresis", law, values, record(loop, 60.0));
    const auto fast = drift("thermal_hysteresis", law, values, record(loop, 1.0));
    CHECK(slow == fast);
    CHECK(slow[200 + 200] == Approx(-0.02));  // 20 degC on the way down
    CHECK(slow[200 + 400 + 200] == Approx(0.02));
  }
}

TEST_CASE(
    "the play forgets what happened inside its width, the relay switches at two temperatures") {
  const auto quiet = drift("thermal_hysteresis", "play", std::vector<double>{0.02, 2.5},
                           record(path({20.0, 40.0, 39.0, 40.0})));
  CHECK(quiet.back() == Approx(0.02));
  CHECK(quiet[210] == Approx(0.02 * (1.0 - 1.0 / 2.5)));  // 1 degC back
  const auto relay = drift("thermal_hysteresis", "relay", std::vector<double>{0.02, 20.0, 3.0},
                           record(path({10.0, 30.0, 10.0})));
  CHECK(relay[129] == -0.02);  // 22.9 degC rising
  CHECK(relay[132] == 0.02);
  CHECK(relay[200 + 129] == 0.02);  // 17.1 degC falling
  CHECK(relay[200 + 132] == -0.02);
}

TEST_CASE("self_heating starts anew with the power, and the board's sensor sees its share") {
  RigModel model = with(silent_rig(), use("self_heating", "direct", {{"a", 0.1}, {"tau", 600.0}}));
  const ChamberAir air(ChamberPhysics{});
  RigBoard board(model, 1, 0);
  board.start(0, 1.0);
  std::vector<RigSample> samples;
  board.take(air, 3601, samples);
  board.power_on(3600'000'000'000);
  board.take(air, 1200, samples);
  const double settled = model.baseline.bias[2].at(23.0);
  CHECK(samples[0].gyro_lsb[2] / 30000.0 == Approx(settled + 0.1).margin(1e-4));
  CHECK(samples[600].gyro_lsb[2] / 30000.0 == Approx(settled + 0.1 * std::exp(-1.0)).margin(1e-4));
  CHECK(samples[3599].gyro_lsb[2] / 30000.0 == Approx(settled).margin(3e-4));
  CHECK(samples[3602].gyro_lsb[2] / 30000.0 == Approx(settled + 0.1).margin(1e-3));

  const Law& die = law_of("self_heating", "die");
  const std::vector<double> values{2.0, 600.0, 0.4};
  const auto reading = die.board_reading(values);
  Drivers now;
  now.t_on_s = 1e6;
  CHECK(reading->at(now) == Approx(0.8));
  CHECK(die.drift(values, z)->at(now) == Approx(z.at(22.0) - z.at(20.0)));
}

TEST_CASE("aging_drift: linear per hour; the other laws start at the same rate and fall behind") {
  std::vector<Drivers> rows(3);
  rows[1].t_s = 36.0;
  rows[2].t_s = 36000.0;
  const std::vector<double> one{1.0};
  CHECK(drift("aging_drift", "linear", one, rows)[2] == Approx(0.010));
  for (const std::string law : {"logarithmic", "diffusive"}) {
    const auto dps = drift("aging_drift", law, std::vector<double>{1.0, 5.0}, rows);
    CHECK(dps[1] == Approx(0.00001).epsilon(0.002));
    CHECK(dps[2] < 0.008);
  }
  CHECK(drift("aging_drift", "logarithmic", std::vector<double>{1.0, 5.0}, rows)[2] ==
        Approx(0.005 * std::log(3.0)));
}

TEST_CASE("bias_jump is there at its instant and stays") {
  std::vector<Drivers> rows(3);
  rows[0].t_s = 99.9;
  rows[1].t_s = 100.0;
  rows[2].t_s = 1e6;
  const auto step = drift("bias_jump", "step", std::vector<double>{0.02, 100.0}, rows);
  CHECK(step == std::vector<double>{0.0, 0.02, 0.02});
  const auto slide = drift("bias_jump", "slide", std::vector<double>{0.02, 90.0, 20.0}, rows);
  CHECK(slide[1] == Approx(0.01));
}

TEST_CASE("mode_crossing repeats at its temperature in both directions") {
  const auto rows = record(path({0.0, 40.0, 0.0}));
  for (const auto& law : find_effect("mode_crossing")->laws) {
    CAPTURE(law->info.name);
    const auto dps = drift_over(*law, usual_values(*law), z, rows);
    for (std::size_t i = 0; i < 400; ++i) CHECK(dps[i] == Approx(dps[800 - i]).margin(1e-9));
  }
  const std::vector<double> values{0.03, 17.0, 1.5};
  CHECK(drift("mode_crossing", "absorptive", values, rows)[170] == Approx(0.03));
  CHECK(drift("mode_crossing", "dispersive", values, rows)[185] == Approx(0.015));
  CHECK(drift("mode_crossing", "turn", values, rows)[185] == Approx(0.03 * std::tanh(1.0)));
  const std::vector<double> mixed{0.03, 17.0, 1.5, 90.0};
  CHECK(drift("mode_crossing", "mixed", mixed, rows)[185] == Approx(0.015));
}

TEST_CASE("condensation comes on heating passes below the dew point and dries") {
  std::vector<Drivers> rows(4000);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    Drivers& now = rows[i];
    now.t_s = 5.0 * static_cast<double>(i);
    // the air triangles between -10 and 20 degC, the board trails it by 2 degC
    const double phase = std::fmod(now.t_s / 9000.0, 1.0);
    const bool heating = phase < 0.5;
    now.chamber_c = heating ? -10.0 + 60.0 * phase : 20.0 - 60.0 * (phase - 0.5);
    now.board_c = now.chamber_c + (heating ? -2.0 : 2.0);
  }
  const std::vector<double> values{0.03, 3.0, 120.0, 900.0};
  const auto each = drift("condensation_step", "film", values, rows);
  const auto once = drift("condensation_step", "film_once", values, rows);
  const auto peak = [](const std::vector<double>& dps, std::size_t from, std::size_t to) {
    return *std::max_element(dps.begin() + static_cast<std::ptrdiff_t>(from),
                             dps.begin() + static_cast<std::ptrdiff_t>(to));
  };
  CHECK(each[380] == 0.0);               // below the dew point all through: 1.4 degC
  CHECK(peak(each, 0, 900) > 0.02);      // the first heating pass
  CHECK(each[900] < each[500]);          // dries, and cooling adds nothing
  CHECK(peak(each, 1800, 2700) > 0.02);  // the second pass
  CHECK(peak(once, 0, 900) == peak(each, 0, 900));
  CHECK(peak(once, 1800, 2700) < 0.005);  // the moisture is gone
  CHECK(peak(drift("condensation_step", "logistic", values, rows), 0, 900) > 0.015);
}

TEST_CASE("stress_relaxation decays with its time constant after a step, sign of the step") {
  std::vector<double> die(2000, 20.0);
  for (std::size_t i = 1; i < die.size(); ++i) die[i] = 30.0;
  auto rows = record(die, 10.0);
  rows[0].t_s = 9.999;  // so that the step takes a millisecond
  const auto dps = drift("stress_relaxation", "one_time", std::vector<double>{2.0, 3600.0}, rows);
  CHECK(dps[1] == Approx(0.02).epsilon(1e-5));
  CHECK(dps[361] == Approx(0.02 * std::exp(-1.0)).epsilon(1e-5));
  const auto two =
      drift("stress_relaxation", "two_times", std::vector<double>{2.0, 600.0, 3600.0, 0.25}, rows);
  CHECK(two[361] == Approx(0.02 * (0.25 * std::exp(-6.0) + 0.75 * std::exp(-1.0))).epsilon(1e-5));
  const auto narrow =
      drift("stress_relaxation", "spread", std::vector<double>{2.0, 3600.0, 0.05}, rows);
  CHECK(narrow[361] == Approx(0.02 * std::exp(-1.0)).epsilon(0.03));
}

TEST_CASE("g_sensitivity is odd in the specific force and constant for a board at rest") {
  std::vector<Drivers> rows(2);
  rows[0].acc_g = {0.1, 0.0, 1.0};
  rows[1].acc_g = {-0.1, 0.0, 1.0};
  const auto dps = drift("g_sensitivity", "tilt_creep", std::vector<double>{0.05, 5.0, 5.0}, rows);
  CHECK(dps[0] == Approx(0.005));
  CHECK(dps[1] == Approx(-0.005));
  const Law& reseating = law_of("g_sensitivity", "reseating");
  Drivers later;
  later.t_s = 20000.0;
  const auto tilt = reseating.tilt_g(usual_values(reseating), later);
  CHECK(tilt[0] == Approx(std::sin(5.0 * 3.14159265358979 / 180.0)));
}

TEST_CASE("board_sensor_offset moves the sensor and leaves the gyro alone") {
  const ChamberAir air(ChamberPhysics{});
  const auto plain = samples_of(silent_rig(), air, 100.0, 10);
  const auto offset = samples_of(
      with(silent_rig(), use("board_sensor_offset", "offset", {{"d", 1.5}})), air, 100.0, 10);
  CHECK(offset[9].temperature_raw - plain[9].temperature_raw == 3 * 0x80);
  CHECK(offset[9].gyro_lsb == plain[9].gyro_lsb);
  const Law& gain = law_of("board_sensor_offset", "gain");
  Drivers hot;
  hot.board_c = 50.0;
  CHECK(gain.board_reading(std::vector<double>{0.02})->at(hot) == Approx(0.5));
}

TEST_CASE("flicker has 1/f density over the slow band, a walk 1/f^2") {
  const auto density = [](const std::string& effect, const std::string& law, double amplitude,
                          double f_hz) {
    double sum = 0.0;
    for (const OuTerm& term : law_of(effect, law).stochastic(std::vector<double>{amplitude})) {
      sum += spectral_density(term, f_hz);
    }
    return sum;
  };
  const double b_dps = 7.0 / 3600.0;
  for (double f = 1e-5; f < 0.02; f *= 1.7) {
    CAPTURE(f);
    const double flicker = b_dps * b_dps / (2.0 * 3.14159265358979 * f);
    CHECK(density("bias_instability", "flicker", 7.0, f) == Approx(flicker).epsilon(0.05));
    const double omega = 2.0 * 3.14159265358979 * f;
    CHECK(density("rate_random_walk", "walk", 0.05, f) == Approx(25e-10 / (omega * omega)));
  }
}

TEST_CASE("OU noise has its stationary variance and correlation, a walk grows as K^2 t") {
  const std::vector<OuTerm> terms{{100.0, 4.0}};
  const std::vector<OuTerm> walk{{std::numeric_limits<double>::infinity(), 0.0, 0.25}};
  double square = 0.0, product = 0.0, walked = 0.0;
  constexpr int n = 20000;
  for (std::uint32_t i = 0; i < n; ++i) {
    OuNoise noise(terms, {i, 0, 0, 0});
    const double before = noise.value_dps();
    const double after = noise.advance(50.0);
    square += after * after;
    product += before * after;
    OuNoise walker(walk, {i, 1, 0, 0});
    walker.advance(30.0);
    const double end = walker.advance(70.0);
    walked += end * end;
  }
  CHECK(square / n == Approx(4.0).epsilon(0.05));
  CHECK(product / n == Approx(4.0 * std::exp(-0.5)).epsilon(0.06));
  CHECK(walked / n == Approx(25.0).epsilon(0.05));
}
