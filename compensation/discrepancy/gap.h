#pragma once

#include <span>
#include <vector>

#include "compensation/discrepancy/diagnosis.h"
#include "compensation/discrepancy/mean_law.h"
#include "compensation/discrepancy/segments.h"
#include "compensation/discrepancy/slow_search.h"
#include "compensation/discrepancy/slow_smoother.h"
#include "compensation/discrepancy/track.h"

namespace gyrocal {

/// A state of the simulation to be held against kept-out data.
struct Simulation {
  std::vector<double> course_dps;      ///< deterministic rate at the track's instants
  SlowNoiseShape shape;                ///< drift noise it knows of
  std::vector<RelaxingPart> relaxing;  ///< and telegraphs too slow for a dwell
  double white_sd_dps = 0;             ///< of the mean over one second, in the slow stream
  double sample_sd_dps = 0;            ///< white noise per sample at 20 degC
  double lsb_dps = 0;                  ///< 0: continuous
  rig::RigModel fast;                  ///< baseline and effects on samples, codes and link only
  MeanLaw mean_law{{}, 0, 0};          ///< true rate -> mean of the samples
};

/// Rate as the monitor would show it at each monitor row: the course, what drift noise must have
/// been doing by the training rows around, and the converter's law.
/// @return one per row; and the variance of the drift estimate in `variance` if given.
[[nodiscard]] std::vector<double> predicted_rows(const Session& session,
                                                 std::span<const Segment> segments,
                                                 const Track& track, const Simulation& simulation,
                                                 std::vector<double>* variance);

/// One number per channel, mean z^2 - 1 over fixed features of the kept-out segments, and its part
/// in physical units.
struct GapMeasure {
  double total = 0;  ///< sqrt of the mean of the four, not below 0
  double slow = 0, spectrum = 0, distribution = 0, link = 0;
  double slow_dps = 0, spectrum_db = 0, distribution_share = 0, link_share = 0;
};
[[nodiscard]] GapMeasure measure_gap(const Session& session, std::span<const Segment> segments,
                                     const Track& track, const Simulation& simulation);

}  // namespace gyrocal
