#pragma once
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "tests/hidden_effects/random.h"
#include "tests/hidden_effects/thermal.h"

namespace hidden {

/// Bias over die temperature of the part without any effect: a cubic in (T - 20)/30.
struct Baseline {
  double at_20c_dps;
  double linear_dps;
  double square_dps;
  double cube_dps;
  double operator()(double die_c) const {
    const double u = (die_c - 20.0) / 30.0;
    return at_20c_dps + u * (linear_dps + u * (square_dps + u * cube_dps));
  }
};

using Series = std::vector<double>;  ///< one value a second

/// One effect that shows in the slow stream. Nature's laws, not the catalogue's: several are
/// deliberately of another form than a textbook would fit.
struct SlowLaw {
  std::string name;  ///< as in the catalogue, or "unknown"
  std::string law;
  std::string unit;             ///< of the amplitude
  std::string amplitude_means;  ///< in words, so that an amplitude error can be judged
  bool signed_amplitude = true;
  double amplitude_low = 0.0;  ///< what the catalogue calls possible; an outsider has no range
  double amplitude_high = 1e9;
  std::map<std::string, double> parameters;
  /// Added to the bias [deg/s] at amplitude one. Empty when the effect acts on temperatures.
  std::function<Series(const Trajectory&)> shape;
  /// Put into the thermal chain at that amplitude. Empty when the effect adds to the bias.
  std::function<void(Chain&, double)> heat;
};

/// @param name  one of the deterministic slow effects of the catalogue (g_sensitivity and
///              board_sensor_offset are not: they act on other channels too).
/// @param law   one of laws_of(name).
SlowLaw draw_law(const std::string& name, const std::string& law, const Trajectory& over,
                 Random& random);
std::vector<std::string> laws_of(const std::string& name);

/// Effects nobody listed. @param law  one of laws_of("unknown").
SlowLaw draw_outsider(const std::string& law, const Trajectory& over, Random& random);

}  // namespace hidden
