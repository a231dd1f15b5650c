#pragma once

#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

#include "compensation/discrepancy/executor.h"
#include "compensation/discrepancy/slow_fit.h"
#include "compensation/discrepancy/slow_stream.h"
#include "compensation/discrepancy/track.h"
#include "compensation/rig/effects/catalogue.h"

namespace gyrocal {

/// One deterministic effect under one law, with the numbers fitted for it.
struct SlowTerm {
  const rig::Effect* effect = nullptr;
  const rig::Law* law = nullptr;
  std::vector<double> values;  ///< all parameters; [0] is the amplitude
  double amplitude_sd = 0;
};

/// A way to explain more of the slow stream, and how much.
struct SlowCandidate {
  SlowTerm term;
  /// Gain over the present model when both may use flicker and walk as they like: what no noise
  /// can imitate [nat].
  double nats = 0;
  /// Gain with the noise the present model has [nat].
  double nats_same_noise = 0;
  SlowFit fit;  ///< with all noise free
};

/// The slow stream and the present model of it: a cubic over the die temperature, terms already
/// found, noise already found.
class SlowModel {
 public:
  SlowModel(const SlowStream& stream, const Track& track);

  /// Deterministic terms of the present model; their shapes are held, their amplitudes are fitted
  /// again with everything else.
  void set_terms(std::vector<SlowTerm> terms);
  /// A course that is known in full (what the rig model at hand already holds) [deg/s].
  void set_known(const std::vector<double>& course);
  void set_noise(const NoiseFamily& family);
  /// Courses without a law (a sine, a smooth curve), each with an amplitude of its own to fit.
  void set_shapes(std::vector<std::vector<double>> courses);
  /// Known in the bins only (which level a telegraph is in) [deg/s].
  void set_known_bins(const Eigen::VectorXd& bins);

  [[nodiscard]] const std::vector<SlowTerm>& terms() const { return terms_; }
  [[nodiscard]] const NoiseFamily& noise() const { return noise_; }
  [[nodiscard]] const std::vector<std::vector<double>>& shapes() const { return shapes_; }
  [[nodiscard]] const Eigen::VectorXd& known_bins() const { return known_bins_; }
  [[nodiscard]] const SlowFit& fit() const { return fit_; }            ///< with the present noise
  [[nodiscard]] const SlowFit& fit_free() const { return fit_free_; }  ///< with all noise
  /// What flicker and a random walk would gain that the present noise does not have [nat].
  [[nodiscard]] double noise_gain_nats() const {
    return fit_free_.log_likelihood - fit_.log_likelihood;
  }
  [[nodiscard]] const rig::CubicBias& bias() const { return bias_; }
  [[nodiscard]] const Eigen::MatrixXd& design() const { return design_; }
  [[nodiscard]] const Eigen::VectorXd& y() const { return y_; }
  [[nodiscard]] const SlowStream& stream() const { return *stream_; }
  [[nodiscard]] const Track& track() const { return *track_; }

  /// What a term adds at amplitude `values[0]`, in bins [deg/s].
  [[nodiscard]] Eigen::VectorXd column(const rig::Law& law,
                                       const std::vector<double>& values) const;
  /// The whole prediction at the track's instants: cubic, known course, terms.
  [[nodiscard]] std::vector<double> prediction() const;

  /// Fits the noise and all coefficients anew, and the terms' amplitudes into terms().
  void refit();

 private:
  void build_design();
  const SlowStream* stream_;
  const Track* track_;
  std::vector<SlowTerm> terms_;
  std::vector<double> known_;
  Eigen::VectorXd known_bins_;
  std::vector<std::vector<double>> shapes_;
  Eigen::VectorXd y_;
  NoiseFamily noise_;
  rig::CubicBias bias_;
  Eigen::MatrixXd design_;
  SlowFit fit_, fit_free_;
};

/// Noise settings to try something at: all that noise can take, a twentieth of it, the present.
[[nodiscard]] std::array<SlowNoiseShape, 3> noise_settings(const SlowModel& model);

/// Trial values of a law over this record: coarse, one set a row, amplitude first. Shapes stay in
/// the ranges of effects.md, places inside the temperatures and times that occur.
[[nodiscard]] std::vector<std::vector<double>> trial_values(const rig::Effect& effect,
                                                            const rig::Law& law,
                                                            const Track& track);

/// Every deterministic effect of the catalogue against the present model: the best law and shape
/// of each, shapes and noise refined together for those that gain something. Best first.
[[nodiscard]] std::vector<SlowCandidate> search_effects(const SlowModel& model,
                                                        const Executor& run_all);

/// One law from given values on: shapes and noise refined together.
[[nodiscard]] SlowCandidate refine(const SlowModel& model, const rig::Effect& effect,
                                   const rig::Law& law, std::vector<double> values,
                                   const SlowNoiseShape& start);

}  // namespace gyrocal
