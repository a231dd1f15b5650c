#include "compensation/discrepancy/between_channels.h"

#include <algorithm>
#include <cmath>

#include "compensation/discrepancy/slow_story.h"

namespace gyrocal {
namespace {

bool is_effect(const Finding& finding, const char* name) { return finding.effect == name; }

/// Sines of one grid are one hum: the strongest leads, another is told as a share of it.
void merge_harmonics(std::vector<Finding>& findings) {
  const auto first = among(findings, "mains_hum");
  if (first == findings.end()) return;
  for (auto other = first + 1; other != findings.end();) {
    if (!is_effect(*other, "mains_hum")) {
      ++other;
      continue;
    }
    for (auto& [name, value] : first->parameters) {
      if (name == "second") value = other->amplitude / first->amplitude;
    }
    first->evidence_nats += other->evidence_nats;
    other = findings.erase(other);
  }
}

/// Two levels that both channels see are one telegraph. Rows see whole stays where a dwell sees
/// parts of some: theirs are the numbers.
void merge_telegraphs(std::vector<Finding>& slow, std::vector<Finding>& fast) {
  constexpr double same_level = 1.4;
  const auto in_rows = among(slow, "random_telegraph_noise");
  const auto in_dwells = among(fast, "random_telegraph_noise");
  if (in_rows == slow.end() || in_dwells == fast.end()) return;
  const double ratio = in_rows->amplitude / in_dwells->amplitude;
  if (ratio > same_level || ratio < 1 / same_level) return;
  in_rows->evidence_nats += in_dwells->evidence_nats;
  in_rows->lead_nats = std::max(in_rows->lead_nats, in_dwells->lead_nats);
  fast.erase(in_dwells);
}

/// The longest row of codes that never come.
std::size_t widest_hole(const std::vector<std::int64_t>& holes) {
  std::size_t widest = 0, here = 0;
  for (std::size_t i = 0; i < holes.size(); ++i) {
    here = i > 0 && holes[i] == holes[i - 1] + 1 ? here + 1 : 1;
    widest = std::max(widest, here);
  }
  return widest;
}

/// The largest window in temperature that codes could still make of themselves [counts]. Holes that
/// no dwell came near bend the means on the way, by half of what is missing in a row. The bend of
/// rounding itself is undone to a few hundredths.
double code_bend_lsb(const CodeFindings& codes, bool holes_told) {
  constexpr double rounding_lsb = 0.05;
  if (!holes_told) return rounding_lsb;
  return std::max<double>(1, static_cast<double>(widest_hole(codes.holes))) / 2;
}

/// A board that reads warmer than the air may be warmed by its own electronics: what heats it could
/// then be what drifts, though the drift alone would rather have another name.
void doubt_beside_a_warm_board(std::vector<Finding>& slow, std::vector<Finding>& fast) {
  constexpr double lead_nats_max = 15;
  const auto sensor = among(fast, "board_sensor_offset");
  if (sensor == fast.end() || sensor->law != "offset" || sensor->amplitude < 0) return;
  for (Finding& finding : slow) {
    const bool close = std::any_of(finding.candidates.begin(), finding.candidates.end(),
                                   [&](const Candidate& candidate) {
                                     return candidate.effect == "self_heating" &&
                                            candidate.nats > finding.evidence_nats - lead_nats_max;
                                   });
    auto& rivals = finding.confounded_with;
    if (!close || finding.effect == "self_heating" || finding.effect == "unknown") continue;
    if (std::count(rivals.begin(), rivals.end(), "self_heating") > 0) continue;
    rivals.emplace_back("self_heating");
    finding.lead_nats = std::min(finding.lead_nats, lead_to_name_nats);
  }
}

}  // namespace

std::vector<Finding>::iterator among(std::vector<Finding>& findings, const char* effect) {
  return std::find_if(findings.begin(), findings.end(),
                      [effect](const Finding& f) { return is_effect(f, effect); });
}

void settle_between_channels(std::vector<Finding>& slow, std::vector<Finding>& fast,
                             const CodeFindings& codes, double lsb_dps, bool bends) {
  doubt_beside_a_warm_board(slow, fast);
  // A board warmed by its own electronics reads warmer than the air: no fault of its sensor.
  const bool may_warm = std::any_of(slow.begin(), slow.end(), [](const Finding& f) {
    return is_effect(f, "self_heating") ||
           std::count(f.confounded_with.begin(), f.confounded_with.end(), "self_heating") > 0;
  });
  if (may_warm) {
    std::erase_if(fast, [](const Finding& f) { return is_effect(f, "board_sensor_offset"); });
  }
  if (bends) {
    const double bend_lsb = code_bend_lsb(codes, among(fast, "missing_codes") != fast.end());
    std::erase_if(slow, [&](const Finding& f) {
      return is_effect(f, "mode_crossing") && std::abs(f.amplitude) < bend_lsb * lsb_dps;
    });
  }
  merge_harmonics(slow);
  merge_telegraphs(slow, fast);
  const auto step = among(slow, "compressor_vibration");
  const auto line = among(fast, "compressor_vibration");
  if (step != slow.end() && line != fast.end()) {
    line->law = "line_and_step";
    line->parameters = {{"a", line->amplitude},
                        {"f", line->parameters[1].second},
                        {"v", step->amplitude},
                        {"acc", 0.0}};
    line->evidence_nats += step->evidence_nats;
    line->lead_nats += step->lead_nats;
    slow.erase(step);
  }
}

bool is_flicker_throughout(const SlowModel& slow, double flicker_lead_nats) {
  if (!slow.noise().walk || slow.noise().flicker) return false;
  SlowModel instead = slow;
  instead.set_noise({.flicker = true, .walk = false});
  instead.refit();
  return instead.fit().log_likelihood - slow.fit().log_likelihood > flicker_lead_nats;
}

}  // namespace gyrocal
