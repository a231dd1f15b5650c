#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "compensation/discrepancy/slow_search.h"
#include "compensation/discrepancy/smoother.h"

namespace gyrocal {

/// What else was tried in the place of a finding.
struct SlowRank {
  std::string effect, law;
  double nats = 0;
};

/// One addition to the model of the slow stream.
struct SlowFinding {
  std::string effect;  ///< of the catalogue, or "unknown"
  std::string law;
  std::optional<SlowTerm> term;  ///< deterministic ones
  double amplitude = 0;          ///< in the catalogue's unit
  double amplitude_sd = 0;
  /// What is told instead where a law's own number depends on its shape: mean aging per hour over
  /// the record, largest drift of a film. 0: the amplitude itself.
  double effective_amplitude = 0;
  std::vector<std::pair<std::string, double>> parameters;
  double evidence_nats = 0;                  ///< over the model without it
  double lead_nats = 0;                      ///< over the best of another name
  std::vector<std::string> rivals;           ///< names within `lead_to_name_nats`
  std::string unknown_driver;                ///< unknown ones: what it follows
  std::string description;                   ///< unknown ones: shape, size, place, as a sentence
  std::vector<SlowRank> ranking;             ///< what was tried in its place, best first
  std::vector<std::vector<double>> courses;  ///< what it adds to the model's shapes, if anything
};

inline constexpr double gate_nats = 10;
inline constexpr double lead_to_name_nats = 5;
/// What the drift that a rig model already holds may leave over, as a share of what it explains.
inline constexpr double known_leftover_share = 0.12;

/// Rounds of search, naming, refitting and swapping, until nothing is left or four things have been
/// found. Leaves in `model` the terms, noise and shapes found.
/// @param sample_rate_hz  tells which slow sine may be the alias of a mains frequency.
/// @param interval_s  of the monitor: how well the instants of temperatures are known.
/// @param gate  what a law must gain [nat], at least `gate_nats`.
/// @param excluded  effects not to be searched for: named by another channel, or impossible here.
[[nodiscard]] std::vector<SlowFinding> tell_slow_story(SlowModel& model, double sample_rate_hz,
                                                       double interval_s,
                                                       const std::vector<std::string>& excluded,
                                                       double gate, double known_nats,
                                                       const Executor& run_all);

}  // namespace gyrocal
