#include "compensation/experiment/plan_power.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "compensation/discrepancy/diagnosis.h"
#include "compensation/discrepancy/model_update.h"
#include "compensation/discrepancy/off_design.h"
#include "compensation/discrepancy/scan_columns.h"
#include "compensation/discrepancy/slow_story.h"
#include "compensation/rig/effects/catalogue.h"
#include "compensation/rig/simulate_session.h"

namespace gyrocal {
namespace {

constexpr Eigen::Index bins_min = 24;
constexpr double observable_share = 1e-4;  // of a trace's length that the bias curve leaves

/// Every shape of one effect as a whitened trace off the design, of unit length.
struct Traces {
  const rig::Effect* effect;
  Eigen::MatrixXd unit;       ///< a column each; none: not observable
  Eigen::Index typical = 0;   ///< the column its limit is told for
  double typical_length = 0;  ///< of that trace at amplitude `at`, in deviations
  double at = 1;
};

/// What one law adds, all shapes; traces the bias curve makes by itself are left out.
void add_law(const ScanColumns& law, const OffDesign& design, double white_sd_dps, Traces& traces) {
  const bool is_usual_law = traces.effect->laws.front().get() == law.law;
  const Eigen::MatrixXd white = design.whitener().whiten(law.columns);
  const Eigen::MatrixXd off = design.off_white(white);
  const Eigen::Index before = traces.unit.cols();
  traces.unit.conservativeResize(white.rows(), before + off.cols());
  Eigen::Index kept = before;
  for (Eigen::Index i = 0; i < off.cols(); ++i) {
    const double length = off.col(i).norm();
    if (length <= observable_share * white.col(i).norm() || length == 0) continue;
    if (is_usual_law && (kept == before || i <= off.cols() / 2)) {
      traces.typical = kept;
      traces.typical_length = length / white_sd_dps;
      traces.at = law.rows[static_cast<std::size_t>(i)].front();
    }
    traces.unit.col(kept++) = off.col(i) / length;
  }
  traces.unit.conservativeResize(Eigen::NoChange, kept);
}

std::vector<Traces> all_traces(const SlowModel& model) {
  const OffDesign design(model, model.fit().shape);
  std::vector<Traces> all;
  for (const ScanColumns& law : scan_columns(model)) {
    if (all.empty() || all.back().effect != law.effect) {
      all.push_back({law.effect, Eigen::MatrixXd(model.y().size(), 0)});
    }
    add_law(law, design, model.fit().white_sd_dps, all.back());
  }
  std::erase_if(all, [](const Traces& traces) { return traces.typical_length == 0; });
  return all;
}

std::string advice_against(const rig::Effect& effect, std::string_view rival) {
  for (const rig::Confusion& confusion : effect.confused_with) {
    if (confusion.effect == rival) return std::string(confusion.tell_apart);
  }
  return {};
}

PlanPair pair_of(const Traces& effect, const Traces& rival) {
  const Eigen::VectorXd alike = rival.unit.transpose() * effect.unit.col(effect.typical);
  PlanPair pair;
  pair.effect = effect.effect->name;
  pair.rival = rival.effect->name;
  pair.unit = effect.effect->laws.front()->info.parameters.front().unit;
  pair.share_left = std::max(0.0, 1 - alike.cwiseAbs2().maxCoeff());
  pair.apart_from = std::sqrt(2 * lead_to_name_nats / pair.share_left) / effect.typical_length *
                    std::abs(effect.at);
  pair.tell_apart = advice_against(*effect.effect, rival.effect->name);
  if (pair.tell_apart.empty()) {
    pair.tell_apart = advice_against(*rival.effect, effect.effect->name);
  }
  return pair;
}

/// Each pair once, told for the effect that is harder to tell from the other.
std::vector<PlanPair> all_pairs(const std::vector<Traces>& traces) {
  std::vector<PlanPair> pairs;
  for (std::size_t i = 0; i < traces.size(); ++i) {
    for (std::size_t j = i + 1; j < traces.size(); ++j) {
      const PlanPair one = pair_of(traces[i], traces[j]);
      const PlanPair other = pair_of(traces[j], traces[i]);
      pairs.push_back(one.share_left <= other.share_left ? one : other);
    }
  }
  std::stable_sort(pairs.begin(), pairs.end(), [](const PlanPair& a, const PlanPair& b) {
    return a.share_left < b.share_left;
  });
  return pairs;
}

/// The pairs of drifts of a simulated session.
Result<std::vector<PlanPair>> pairs_of(const Session& session, const rig::RigModel& model,
                                       Axis axis) {
  const auto instances = rig::instantiate(model);
  if (!instances) return tl::unexpected(instances.error());
  const std::vector<Segment> segments = split_segments(session);
  const Track track = make_track(session, segments, model.baseline);
  const RowChoice rows = training_rows(session, segments);
  const std::vector<double> no_factor(track.record.size(), 1.0);
  const SlowStream stream(session, rows.rows, track, bin_width_s(session), no_factor);
  if (stream.size() < bins_min) {
    return fail(Errc::too_few_points,
                fmt::format("the plan gives {} bins of {:.0f} s to judge by, expected at least {}",
                            stream.size(), bin_width_s(session), bins_min),
                "plan more setpoints or longer soaks");
  }
  SlowModel slow(stream, track);
  give_known_effects(*instances, model, static_cast<std::size_t>(axis), slow);
  return all_pairs(all_traces(slow));
}

Result<Session> simulated(const rig::SessionPlan& plan, const rig::RigModel& model, Axis axis) {
  if (auto good = rig::check(plan); !good) return tl::unexpected(good.error());
  if (const auto known = rig::instantiate(model); !known) return tl::unexpected(known.error());
  return rig::simulate_session(model, plan, plan_seed, {0, axis});
}

Result<PlanContrast> contrast_of(const Session& session, const rig::SessionPlan& plan,
                                 const rig::RigModel& model, Axis axis) {
  auto pairs = pairs_of(session, model, axis);
  if (!pairs) return tl::unexpected(pairs.error());
  const double end_s = rig::schedule(plan, model.baseline.chamber, plan_seed).end_s;
  return PlanContrast{end_s / 3600, std::move(*pairs)};
}

}  // namespace

bool is_told_apart(const PlanPair& pair) {
  // apart_from / limit = sqrt(2 lead / (2 gate share)).
  return lead_to_name_nats <= told_apart_factor * told_apart_factor * gate_nats * pair.share_left;
}

Result<PlanContrast> plan_contrast(const rig::SessionPlan& plan, const rig::RigModel& model,
                                   Axis axis) {
  const auto session = simulated(plan, model, axis);
  if (!session) return tl::unexpected(session.error());
  return contrast_of(*session, plan, model, axis);
}

Result<PlanPower> plan_power(const rig::SessionPlan& plan, const rig::RigModel& model, Axis axis) {
  const auto session = simulated(plan, model, axis);
  if (!session) return tl::unexpected(session.error());
  auto contrast = contrast_of(*session, plan, model, axis);
  if (!contrast) return tl::unexpected(contrast.error());
  const auto diagnosis = diagnose(*session, model, {});
  if (!diagnosis) return tl::unexpected(diagnosis.error());
  PlanPower power;
  power.duration_h = contrast->duration_h;
  power.pairs = std::move(contrast->pairs);
  power.dwells = static_cast<int>(session->dwells.size());
  power.not_observable = diagnosis->not_observable;
  for (const rig::Effect& effect : rig::catalogue()) {
    const auto found = diagnosis->detection_limits.find(std::string(effect.name));
    if (found == diagnosis->detection_limits.end()) continue;
    power.limits.push_back({found->first,
                            std::string(effect.laws.front()->info.parameters.front().unit),
                            found->second});
  }
  return power;
}

}  // namespace gyrocal
