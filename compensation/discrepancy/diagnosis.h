#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "compensation/discrepancy/executor.h"
#include "compensation/rig/rig_model.h"
#include "compensation/values/error.h"
#include "compensation/values/records.h"

namespace gyrocal {

enum class Verdict { consistent, explained, unexplained, confounded };
[[nodiscard]] std::string to_text(Verdict verdict);

/// What the search held against a finding in its place, and what it gained there.
struct Candidate {
  std::string effect;
  std::string law;
  double nats = 0;         ///< over the model without it, shape parameters paid for
  std::string tell_apart;  ///< from the finding: an observation; empty where none is known
};

/// One thing the present rig model lacks.
struct Finding {
  std::string effect;  ///< a name of DESIGN section 10, or "unknown"
  std::string law;
  double amplitude = 0;
  std::string unit;                                        ///< of effects.md
  std::vector<std::pair<std::string, double>> parameters;  ///< all of the law's, by name
  double standard_error = 0;
  double evidence_nats = 0;  ///< over the model without it
  double lead_nats = 0;      ///< over the best effect of another name
  std::vector<std::string> confounded_with;
  std::string tell_apart;
  std::string description;
  std::vector<Candidate> candidates;  ///< of the slow stream, best first, this one among them
};

/// How far the simulation is off on kept-out data: before the findings and with them.
struct GapChannel {
  double before = 0;
  double after = 0;
};
struct Gap {
  double before = 0, after = 0;  ///< error bars beyond chance; 0: they agree to the noise
  GapChannel slow;               ///< mean z^2 - 1
  GapChannel spectrum, distribution, link;
  GapChannel slow_dps;            ///< rms of measured - simulated above the noise floor [deg/s]
  GapChannel spectrum_db;         ///< rms level difference of ten bands [dB]
  GapChannel distribution_share;  ///< mean absolute difference of the spread, relative
  GapChannel link_share;          ///< difference of the share of lost frames
  std::vector<int> held_out_dwells;
};

struct GapStep {
  std::string added;  ///< empty: the model as given
  double gap = 0;
};

/// Mean spectrum of the kept-out dwells, measured and simulated [(deg/s)^2/Hz].
struct SpectrumRow {
  double f_hz, measured, before, after;
};

/// measured, before, after at one monitor row [deg/s].
struct PredictionRow {
  double t_s, measured_dps, before_dps, after_dps;
};

struct Diagnosis {
  Verdict verdict = Verdict::consistent;
  std::vector<Finding> findings;
  Gap gap;
  double gate_nats = 0;  ///< what a slow effect had to gain, by simulated sessions without any
  std::map<std::string, double> detection_limits;  ///< effect: smallest amplitude seen
  std::vector<std::string> not_observable;         ///< effects this session cannot show at all
  std::vector<GapStep> steps;
  rig::RigModel model;  ///< the given one with this session's baseline and the findings added
  std::vector<PredictionRow> prediction;
  std::vector<SpectrumRow> spectrum;  ///< empty if no dwell is kept out
  std::vector<std::string> notes;     ///< what was lost or assumed
};

struct DiagnoseOptions {
  Executor run_all = run_in_turn;  ///< shares the work; the answer does not depend on it
};

/// Compares a session with what the rig model predicts from its measured temperatures, names what
/// is missing, and measures the gap on data kept out of every fit.
/// @return bad_input, not_finite, out_of_range or too_few_points for a session that cannot be
///   judged; unknown_name or out_of_range for a rig model that cannot be run.
/// Source: discrepancy_methods.md sections 2 and 3.
[[nodiscard]] Result<Diagnosis> diagnose(const Session& session, const rig::RigModel& model,
                                         const DiagnoseOptions& options);

}  // namespace gyrocal
