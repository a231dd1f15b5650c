#pragma once
#include <map>
#include <string>
#include <vector>

#include "tests/hidden_effects/slow_laws.h"

namespace hidden {

/// How well one signature shows in its session beside each rival, at one amplitude.
struct Visibility {
  double gain_nats;                         ///< over "no effect"
  double own_loss_nats;                     ///< what the textbook forms of its own class leave over
  std::map<std::string, double> lead_nats;  ///< over each other class, own loss taken off

  double smallest_lead() const;
  std::vector<std::string> rivals_within(double nats) const;
};

/// One shape a rival could take, seen in one noise's own units beside the signature.
struct RivalShape {
  double along;   ///< inner product with the signature at amplitude one
  double energy;  ///< squared norm
  double least;   ///< what the shape can be multiplied by
  double greatest;

  /// Energy left of `amplitude` times a signature of this energy.
  double left(double amplitude, double signature_energy) const;
};

/// Expected cost of explaining a signature by the best of some noises and, for a rival, of its
/// shapes.
class Cost {
 public:
  /// @param fixed_nats  what the noise costs by itself; energy: of the signature, at amplitude one.
  void add(double fixed_nats, double energy, std::vector<RivalShape> shapes);
  double at(double amplitude) const;

 private:
  struct InNoise {
    double fixed_nats;
    double energy;
    std::vector<RivalShape> shapes;
  };
  std::vector<InNoise> noises_;
};

/// Expected log-likelihood ratios of a slow signature, before any noise is drawn: white noise and a
/// little flicker, the cubic in die temperature projected out, and the noise (white, flicker,
/// random walk) fitted again to whatever a rival leaves unexplained.
class Sight {
 public:
  /// @param signature_dps      one value a second at amplitude one.
  /// @param name               its class ("unknown" has no textbook form: own loss 0).
  /// @param white_per_root_hz  white noise, sigma/sqrt(sample rate) [deg/s/sqrt(Hz)].
  /// @param known              further signatures (amplitudes free) the session holds besides.
  Sight(const Trajectory& over, const Baseline& baseline, const Series& signature_dps,
        const std::string& name, double white_per_root_hz, const std::vector<Series>& known);

  /// Where nine sessions of ten gain 10 nats: an expected gain of 16.5, as its root scatters by
  /// one.
  double smallest_amplitude() const;
  Visibility at(double amplitude) const;

 private:
  std::string name_;
  Cost alone_;
  std::map<std::string, Cost> beside_;
};

/// What a flicker of this many parts of the white variance of a bin gains when fitted, expected
/// [nats].
double flicker_gain_nats(double share);

}  // namespace hidden
