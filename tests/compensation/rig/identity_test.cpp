#include <catch2/catch.hpp>
#include <cmath>

#include "tests/compensation/rig/rig_fixture.h"

using namespace gyrocal;
using namespace gyrocal::rig;

namespace {

/// One board through up_and_down(), a sample at each step of its physics: what it sent and what its
/// drivers were.
struct Run {
  std::vector<RigSample> samples;
  std::vector<Drivers> drivers;
};

Run run(const RigModel& model) {
  const ChamberAir air = up_and_down();
  RigBoard board(model, 1, 0);
  board.start(0, 5.0);
  Run made;
  for (int i = 0; i < 15000 * 5; ++i) {
    board.take(air, 1, made.samples);
    made.drivers.push_back(board.drivers());
  }
  return made;
}

}  // namespace

TEST_CASE("what an effect generates without noise is what it predicts, every law") {
  for (const Effect& effect : catalogue()) {
    for (const auto& law : effect.laws) {
      const RigModel model =
          with(silent_rig(), use(std::string(effect.name), std::string(law->info.name), {}));
      if (!law->drift(usual_values(*law), CubicBias{}) || law->samples(usual_values(*law), {})) {
        continue;
      }
      CAPTURE(effect.name, law->info.name);
      const Run made = run(model);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const CubicBias& bias = model.baseline.bias[axis];
        const auto drift = drift_over(*law, usual_values(*law), bias, made.drivers);
        double worst_lsb = 0.0;
        for (std::size_t i = 0; i < drift.size(); ++i) {
          const double dps = bias.at(made.drivers[i].die_c) + drift[i];
          worst_lsb = std::max(worst_lsb, std::abs(dps * 30000.0 - made.samples[i].gyro_lsb[axis]));
        }
        CHECK(worst_lsb <= 0.5 + 1e-6);
      }
    }
  }
}

TEST_CASE("a prediction on coarse rows is the prediction on fine ones") {
  const Run made = run(silent_rig());
  const CubicBias bias = silent_rig().baseline.bias[2];
  std::vector<Drivers> coarse;  // every 20 s
  for (std::size_t i = 0; i < made.drivers.size(); i += 100) coarse.push_back(made.drivers[i]);
  for (const Effect& effect : catalogue()) {
    // Where drift switches at an instant, or follows what lies between the rows, one row may
    // differ.
    if (effect.name == "condensation_step") continue;
    for (const auto& law : effect.laws) {
      CAPTURE(effect.name, law->info.name);
      const auto values = usual_values(*law);
      const auto fine = drift_over(*law, values, bias, made.drivers);
      const auto rough = drift_over(*law, values, bias, coarse);
      double size = 0.0;
      std::vector<double> differences;
      for (std::size_t i = 0; i < rough.size(); ++i) {
        size = std::max(size, std::abs(fine[100 * i]));
        differences.push_back(std::abs(rough[i] - fine[100 * i]));
      }
      std::sort(differences.begin(), differences.end());
      CHECK(differences[differences.size() * 98 / 100] <= 0.01 * size);
    }
  }
}
