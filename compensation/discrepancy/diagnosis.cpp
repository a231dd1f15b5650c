#include "compensation/discrepancy/diagnosis.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "compensation/discrepancy/acceleration.h"
#include "compensation/discrepancy/between_channels.h"
#include "compensation/discrepancy/fast_findings.h"
#include "compensation/discrepancy/gap.h"
#include "compensation/discrepancy/gap_shadow.h"
#include "compensation/discrepancy/median.h"
#include "compensation/discrepancy/model_update.h"
#include "compensation/discrepancy/null_gate.h"
#include "compensation/discrepancy/sample_rows.h"
#include "compensation/discrepancy/session_check.h"
#include "compensation/discrepancy/slow_limits.h"
#include "compensation/discrepancy/slow_story.h"
#include "compensation/discrepancy/spectra.h"
#include "compensation/discrepancy/verdict.h"
#include "compensation/rig/effects/catalogue.h"

namespace gyrocal {
namespace {

std::size_t axis_index(const std::string& axis) {
  return axis == "x" || axis == "X" ? 0 : axis == "y" || axis == "Y" ? 1 : 2;
}

MeanLaw::Converter converter_of(const CodeFindings& codes, double lsb_dps, bool with_findings) {
  MeanLaw::Converter converter;
  converter.lsb_dps = codes.quantised ? lsb_dps : 0;
  converter.sd_dps = codes.white_sd_dps;
  if (!with_findings) return converter;
  if (codes.holes_nats > gate_nats) converter.holes = codes.holes;
  if (codes.upper_nats > gate_nats) converter.upper_dps = codes.upper_dps;
  if (codes.lower_nats > gate_nats) converter.lower_dps = codes.lower_dps;
  return converter;
}

struct Range {
  double low = 1e300, high = -1e300;
};

Range gyro_range(const Session& session) {
  Range range;
  for (const MonitorRow& row : session.monitor) {
    if (std::isnan(row.gyro_dps)) continue;
    range.low = std::min(range.low, row.gyro_dps);
    range.high = std::max(range.high, row.gyro_dps);
  }
  return range;
}

/// Rows near a rail, where means tell no rate. Judged by the median of the rows around each: where
/// a row's own noise decides, those left are the low ones. One lost row takes its neighbours along.
std::vector<bool> rows_at_a_rail(const std::vector<MonitorRow>& rows, const MeanLaw& law) {
  constexpr std::size_t reach = 8;
  std::vector<bool> lost(rows.size(), false);
  const auto is_near = [&](const MonitorRow& row) { return law.is_lost(row.gyro_dps); };
  if (std::none_of(rows.begin(), rows.end(), is_near)) return lost;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const std::size_t begin = i < reach ? 0 : i - reach, end = std::min(i + reach + 1, rows.size());
    std::vector<double> around;
    for (std::size_t k = begin; k < end; ++k) {
      if (!std::isnan(rows[k].gyro_dps)) around.push_back(rows[k].gyro_dps);
    }
    if (around.empty() || !law.is_lost(median_of(std::move(around)))) continue;
    for (std::size_t k = begin; k < end; ++k) lost[k] = true;
  }
  return lost;
}

/// The session as the gyro meant it: what the converter did to means undone, and left out where it
/// cannot be, if enough is left then.
Session unbent(Session session, const MeanLaw& law) {
  if (!law.bends()) return session;
  std::vector<bool> lost = rows_at_a_rail(session.monitor, law);
  const auto lost_rows = static_cast<std::size_t>(std::count(lost.begin(), lost.end(), true));
  if (3 * lost_rows > 2 * lost.size()) lost.assign(lost.size(), false);
  for (std::size_t i = 0; i < lost.size(); ++i) {
    double& gyro_dps = session.monitor[i].gyro_dps;
    gyro_dps = lost[i] || std::isnan(gyro_dps) ? missing : law.rate(gyro_dps);
  }
  return session;
}

/// Effects whose trace in the slow stream another channel has already claimed, or that this
/// session cannot show.
std::vector<std::string> excluded_effects(const FastEvidence& fast, const Track& track,
                                          const std::vector<Finding>& found) {
  std::vector<std::string> names;
  if (!acceleration_varies(track)) names.push_back("g_sensitivity");
  for (const Finding& finding : found) {
    // Its step comes and goes with the compressor: two levels, but not at random.
    if (finding.effect == "compressor_vibration") names.push_back("random_telegraph_noise");
    if (finding.effect != "random_telegraph_noise") continue;
    // The slow side of its Lorentzian would pass for flicker, or be seen as two levels again.
    const bool has_slow_side = fast.telegraph.low_dwell_s + fast.telegraph.high_dwell_s > 2;
    names.push_back(has_slow_side ? "bias_instability" : "random_telegraph_noise");
  }
  return names;
}

/// How much more white noise there is than at 20 degC and at the start, along the track. In steps
/// of a tenth: bins of one weight share their filter.
std::vector<double> noise_factors(const CodeFindings& codes, const Track& track) {
  const double per_c = codes.spread_nats > gate_nats ? codes.spread_percent_per_c / 100 : 0;
  const double per_h = codes.growth_nats > gate_nats ? codes.growth_percent_per_h / 100 : 0;
  std::vector<double> factors;
  factors.reserve(track.record.size());
  for (const rig::Drivers& now : track.record) {
    const double log_factor = per_c * (now.die_c - 20) + per_h * now.t_s / 3600;
    factors.push_back(std::exp(std::round(10 * log_factor) / 10));
  }
  return factors;
}

/// Rows that runs of stuck samples or glitches fell into are no Gaussian's: then even a moderate
/// outlier is left out.
double lone_outlier_sd(const CodeFindings& codes) {
  return codes.stuck_nats > gate_nats || codes.outlier_nats > gate_nats ? 4 : lone_outlier_sd_usual;
}

/// A setup shared by all steps of one diagnosis.
struct Case {
  const Session& session;
  const rig::RigModel& given;
  std::size_t axis;
  std::vector<Segment> segments;
  Track track;
  FastEvidence fast;
  MeanLaw law_before, law_after;
  double row_white_sd_dps = 0;  ///< of a one-second mean, whatever causes it
};

/// The slow side of every telegraph of a model that switches less than once in a bin.
std::vector<RelaxingPart> slow_telegraphs(const rig::RigModel& model) {
  std::vector<RelaxingPart> parts;
  const auto instances = rig::instantiate(model);
  if (!instances) return parts;
  for (const rig::Instance& instance : *instances) {
    const rig::Telegraph telegraph = instance.law->telegraph(instance.values, rig::Drivers{});
    if (telegraph.level_dps == 0) continue;
    const double high = telegraph.high_dwell_s / (telegraph.high_dwell_s + telegraph.low_dwell_s);
    const double tau_s = 1 / (1 / std::max(telegraph.low_dwell_s, 1e-3) +
                              1 / std::max(telegraph.high_dwell_s, 1e-3));
    parts.push_back({tau_s, telegraph.level_dps * telegraph.level_dps * high * (1 - high)});
  }
  return parts;
}

Simulation simulation_of(const Case& c, const SlowModel& model, const rig::RigModel& fast,
                         bool after) {
  Simulation simulation;
  simulation.course_dps = model.prediction();
  // The level of the simulator's white noise comes from the samples, not from a misfit that would
  // excuse itself; the drift noise keeps its absolute size.
  const double from_samples = c.fast.codes.white_sd_dps / std::sqrt(c.session.sample_rate_hz);
  simulation.white_sd_dps = after ? std::max(c.row_white_sd_dps, from_samples) : from_samples;
  const double rescale = std::pow(model.fit().white_sd_dps / simulation.white_sd_dps, 2);
  simulation.shape = model.fit().shape;
  simulation.shape.flicker_ratio *= rescale;
  simulation.shape.walk_ratio *= rescale;
  simulation.relaxing = slow_telegraphs(fast);
  simulation.sample_sd_dps = c.fast.codes.spread_at_20_dps > 0 && after
                                 ? c.fast.codes.spread_at_20_dps
                                 : c.fast.codes.white_sd_dps;
  simulation.lsb_dps = c.fast.codes.quantised ? c.session.lsb_dps : 0;
  simulation.fast = fast;
  simulation.mean_law = after ? c.law_after : c.law_before;
  return simulation;
}

/// The session without the gyro's means where a gap in the record leaves the die's temperature
/// open.
Session out_of_gap_shadows(const Session& measured, const Track& track,
                           std::vector<std::string>& notes) {
  Session session = measured;
  const auto shadowed = rows_in_gap_shadow(measured, track);
  for (const std::size_t row : shadowed) session.monitor[row].gyro_dps = std::nan("");
  if (!shadowed.empty()) {
    notes.push_back(fmt::format(
        "{} monitor rows after gaps are left out: how warm the die was there hangs on what the "
        "chamber did while nothing was recorded",
        shadowed.size()));
  }
  return session;
}

/// What empty columns cost.
void add_notes_on_columns(const Session& session, std::vector<std::string>& notes) {
  const bool board = std::any_of(session.monitor.begin(), session.monitor.end(),
                                 [](const MonitorRow& row) { return !std::isnan(row.board_c); });
  if (!board) {
    notes.push_back(
        "no board temperature: the board's lag is the rig model's, and its sensor cannot be "
        "judged");
  }
  const bool shaken =
      std::any_of(session.samples.begin(), session.samples.end(),
                  [](const SessionSample& sample) { return !std::isnan(sample.acc_g[0]); });
  if (!shaken) {
    notes.push_back(
        "no accelerometer: g_sensitivity cannot be seen, a board that was moved looks like a jump");
  }
}

void store(const GapMeasure& measure, Gap& gap, double GapChannel::*when) {
  gap.slow.*when = measure.slow;
  gap.spectrum.*when = measure.spectrum;
  gap.distribution.*when = measure.distribution;
  gap.link.*when = measure.link;
  gap.slow_dps.*when = measure.slow_dps;
  gap.spectrum_db.*when = measure.spectrum_db;
  gap.distribution_share.*when = measure.distribution_share;
  gap.link_share.*when = measure.link_share;
}

/// What the samples show and the board's temperature sensor, less what the rig model has already.
std::vector<Finding> findings_beside_the_stream(const Case& c,
                                                const std::vector<rig::Instance>& given) {
  std::vector<Finding> found = fast_findings(c.fast, c.session.sample_rate_hz);
  std::erase_if(found, [&](const Finding& finding) {
    return already_modelled(finding, given, c.given.unexplained);
  });
  if (auto sensor = sensor_finding(c.track.board_sensor)) {
    // A board that warms itself reads warmer than the air: no fault of its sensor.
    const bool warms = std::any_of(given.begin(), given.end(), [](const rig::Instance& known) {
      return known.effect->name == "self_heating";
    });
    if (!warms && !already_modelled(*sensor, given, {})) found.push_back(std::move(*sensor));
  }
  return found;
}

/// The gap and the spectra on what is kept out, before the findings and with them.
void add_gap(const Case& c, const Simulation& before, const Simulation& after,
             Diagnosis& diagnosis) {
  const GapMeasure gap_before = measure_gap(c.session, c.segments, c.track, before);
  const GapMeasure gap_after = measure_gap(c.session, c.segments, c.track, after);
  diagnosis.gap.before = gap_before.total;
  diagnosis.gap.after = gap_after.total;
  store(gap_before, diagnosis.gap, &GapChannel::before);
  store(gap_after, diagnosis.gap, &GapChannel::after);
  for (const Segment& segment : c.segments) {
    if (segment.held_out) diagnosis.gap.held_out_dwells.push_back(segment.dwell);
  }
  if (diagnosis.gap.held_out_dwells.empty()) {
    diagnosis.notes.push_back("fewer than four dwells: none is kept out, so there is no gap");
  }
  for (const SpectrumPoint& point :
       compare_spectra(c.session, c.segments, c.track, std::vector<Simulation>{before, after})) {
    diagnosis.spectrum.push_back({point.f_hz, point.measured_dps2_per_hz,
                                  point.simulated_dps2_per_hz[0], point.simulated_dps2_per_hz[1]});
  }
}

/// All that was found, and the models it is added to.
struct Found {
  const SlowModel& before;
  const SlowModel& after;
  const std::vector<SlowFinding>& story;
  const std::vector<Finding>& fast;
  const rig::RigModel& fast_before;
};

/// The gap after each finding: the slow ones in the order they were found, then the samples' ones.
std::vector<GapStep> gap_steps(const Case& c, const Found& found, double gap_before,
                               const Executor& run_all) {
  std::vector<Simulation> simulations;
  std::vector<GapStep> steps{{"", gap_before}};
  SlowModel partial = found.before;
  for (std::size_t k = 1; k <= found.story.size(); ++k) {
    add_findings(partial, found.story, k);
    simulations.push_back(simulation_of(c, partial, found.fast_before, false));
    steps.push_back({found.story[k - 1].effect, 0});
  }
  rig::RigModel part = found.fast_before;
  for (const Finding& finding : found.fast) {
    add_effect(part, finding, c.axis);
    simulations.push_back(simulation_of(c, found.after, part, true));
    steps.push_back({finding.effect, 0});
  }
  run_all(simulations.size(), [&](std::size_t k) {
    steps[k + 1].gap = measure_gap(c.session, c.segments, c.track, simulations[k]).total;
  });
  return steps;
}

/// @param measured  with the rows that are not fitted.
void add_prediction(const Case& c, const Session& measured, const Simulation& before,
                    const Simulation& after, std::vector<PredictionRow>& prediction) {
  const auto rows_before = predicted_rows(c.session, c.segments, c.track, before, nullptr);
  const auto rows_after = predicted_rows(c.session, c.segments, c.track, after, nullptr);
  for (std::size_t i = 0; i < measured.monitor.size(); ++i) {
    const MonitorRow& row = measured.monitor[i];
    prediction.push_back({row.t_s, row.gyro_dps, rows_before[i], rows_after[i]});
  }
}

void add_limits(const Case& c, const SlowModel& slow, Diagnosis& diagnosis) {
  diagnosis.detection_limits = slow_limits(slow);
  diagnosis.detection_limits.merge(fast_limits(c.fast));
  if (!acceleration_varies(c.track)) diagnosis.detection_limits.erase("g_sensitivity");
  add_sensor_limit(c.track.board_sensor, diagnosis.detection_limits);
  for (const rig::Effect& effect : rig::catalogue()) {
    if (!diagnosis.detection_limits.contains(std::string(effect.name))) {
      diagnosis.not_observable.emplace_back(effect.name);
    }
  }
}

}  // namespace

Result<Diagnosis> diagnose(const Session& recorded, const rig::RigModel& model,
                           const DiagnoseOptions& options) {
  if (auto checked = check_session(recorded); !checked) return tl::unexpected(checked.error());
  const auto given = rig::instantiate(model);
  if (!given) return tl::unexpected(given.error());

  Diagnosis diagnosis;
  const auto stand_in = stand_in_for(recorded);
  const Session& measured = stand_in ? *stand_in : recorded;
  if (auto enough = check_rows(measured); !enough) return tl::unexpected(enough.error());
  if (stand_in) {
    diagnosis.notes.push_back(fmt::format(
        "monitor.csv has {} rows with a gyro mean: means of the samples over {:.3g} s stand in for "
        "it; what happened between the dwells is not seen",
        rows_with_gyro(recorded), stand_in->monitor_interval_s));
  }
  std::vector<Segment> segments = split_segments(measured);
  Track track = make_track(measured, segments, model.baseline);
  // What the air did between the dwells is guessed: no measure of the board's sensor.
  if (stand_in) track.board_sensor.observed = false;
  const Session session =
      stand_in ? measured : out_of_gap_shadows(measured, track, diagnosis.notes);
  Case c{session,          model, axis_index(session.axis), std::move(segments),
         std::move(track), {},    MeanLaw({}, 0, 0),        MeanLaw({}, 0, 0)};
  c.fast = gather_fast_evidence(session, c.segments, c.track);
  const Range range = gyro_range(session);
  c.law_before = MeanLaw(converter_of(c.fast.codes, session.lsb_dps, false), range.low, range.high);
  c.law_after = MeanLaw(converter_of(c.fast.codes, session.lsb_dps, true), range.low, range.high);

  if (!c.track.lost.empty()) diagnosis.notes.push_back(c.track.lost);
  add_notes_on_columns(session, diagnosis.notes);
  std::vector<Finding> fast = findings_beside_the_stream(c, *given);

  const Session straight = unbent(session, c.law_after);
  const RowChoice rows = training_rows(straight, c.segments, lone_outlier_sd(c.fast.codes));
  if (rows.rows.size() < monitor_rows_min) {
    return fail(Errc::too_few_points,
                fmt::format("monitor.csv: {} rows are left for fitting, expected at least {}",
                            rows.rows.size(), monitor_rows_min));
  }
  c.row_white_sd_dps = row_white_sd_dps(straight, rows.rows);
  const SlowStream stream(straight, rows.rows, c.track, bin_width_s(straight),
                          noise_factors(c.fast.codes, c.track));
  if (stream.size() < 24) {
    return fail(Errc::too_few_points,
                fmt::format("monitor.csv: {} bins of {:.0f} s are left for fitting, expected at "
                            "least 24",
                            stream.size(), bin_width_s(straight)));
  }
  add_acceleration(straight, stream, c.track);
  SlowModel slow(stream, c.track);
  const double known_nats = give_known_effects(*given, model, c.axis, slow);
  diagnosis.gate_nats = std::max(gate_nats, null_gate_nats(slow));
  if (known_leftover_share * known_nats > diagnosis.gate_nats) {
    diagnosis.notes.push_back(
        fmt::format("the drift that the rig model holds explains {:.0f} nats here: no law being "
                    "exact, a further "
                    "drift is told from {:.0f} nats",
                    known_nats, known_leftover_share * known_nats));
  }
  const SlowModel before = slow;
  rig::RigModel fast_before = fast_part(model);

  const auto tell = [&] {
    return tell_slow_story(slow, session.sample_rate_hz, session.monitor_interval_s,
                           excluded_effects(c.fast, c.track, fast), diagnosis.gate_nats, known_nats,
                           options.run_all);
  };
  std::vector<SlowFinding> story = tell();
  if (among(fast, "random_telegraph_noise") != fast.end() &&
      is_flicker_throughout(slow, c.fast.telegraph.flicker_lead_nats)) {
    fast.erase(among(fast, "random_telegraph_noise"));
    slow = before;
    story = tell();
  }
  diagnosis.findings = to_findings(story);
  settle_between_channels(diagnosis.findings, fast, c.fast.codes, session.lsb_dps,
                          c.law_after.bends());
  std::vector<Finding> settled = diagnosis.findings;
  settled.insert(settled.end(), fast.begin(), fast.end());
  diagnosis.model = updated_model(model, slow, story, settled, c.fast.codes, c.axis);
  const rig::RigModel fast_after = fast_part(diagnosis.model);

  const Simulation sim_before = simulation_of(c, before, fast_before, false);
  const Simulation sim_after = simulation_of(c, slow, fast_after, true);
  add_gap(c, sim_before, sim_after, diagnosis);
  diagnosis.steps =
      gap_steps(c, {before, slow, story, fast, fast_before}, diagnosis.gap.before, options.run_all);
  add_prediction(c, measured, sim_before, sim_after, diagnosis.prediction);
  diagnosis.findings.insert(diagnosis.findings.end(), std::make_move_iterator(fast.begin()),
                            std::make_move_iterator(fast.end()));
  explain(diagnosis.findings);
  diagnosis.verdict = verdict_of(diagnosis.findings);
  add_limits(c, slow, diagnosis);
  return diagnosis;
}

}  // namespace gyrocal
