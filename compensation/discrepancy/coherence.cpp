#include "compensation/discrepancy/coherence.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

namespace gyrocal {
namespace {

constexpr double same_instant_s = 120;
constexpr double same_period_share = 0.01;

std::string place_of(const AxisDiagnosis& one) { return one.board + "/" + one.axis; }

std::optional<double> parameter(const Finding& finding, const std::string& name) {
  for (const auto& [key, value] : finding.parameters) {
    if (key == name) return value;
  }
  return std::nullopt;
}

/// One cause may be behind both.
bool same_thing(const Finding& a, const Finding& b) {
  if (a.effect != b.effect) return false;
  if (a.effect == "unknown" && a.law != b.law) return false;
  if (a.effect == "bias_jump") {
    const auto at_a = parameter(a, "t0"), at_b = parameter(b, "t0");
    return !at_a || !at_b || std::abs(*at_a - *at_b) < same_instant_s;
  }
  const auto period_a = parameter(a, "period_s"), period_b = parameter(b, "period_s");
  if (a.law == "sine" && period_a && period_b) {
    return std::abs(*period_a / *period_b - 1) < same_period_share;
  }
  return true;
}

bool could_show(const Diagnosis& diagnosis, const Finding& finding, double amplitude) {
  if (finding.effect == "unknown") return true;
  const auto limit = diagnosis.detection_limits.find(finding.effect);
  return limit != diagnosis.detection_limits.end() && limit->second < amplitude;
}

struct Group {
  Finding example;
  double smallest = 0;
  std::set<std::size_t> seen;
};

std::vector<Group> group(std::span<const AxisDiagnosis> diagnoses) {
  std::vector<Group> groups;
  for (std::size_t i = 0; i < diagnoses.size(); ++i) {
    for (const Finding& finding : diagnoses[i].diagnosis.findings) {
      const auto known = std::find_if(groups.begin(), groups.end(), [&](const Group& one) {
        return same_thing(one.example, finding);
      });
      const double size = std::abs(finding.amplitude);
      if (known == groups.end()) {
        groups.push_back({finding, size, {i}});
      } else {
        known->smallest = std::min(known->smallest, size);
        known->seen.insert(i);
      }
    }
  }
  return groups;
}

Origin origin_of(std::span<const AxisDiagnosis> diagnoses, const std::set<std::size_t>& seen,
                 const SharedEffect& shared) {
  std::set<std::string> boards, boards_seen;
  for (std::size_t i = 0; i < diagnoses.size(); ++i) {
    boards.insert(diagnoses[i].board);
    if (seen.contains(i)) boards_seen.insert(diagnoses[i].board);
  }
  const bool on_every_board = boards_seen.size() == boards.size();
  if (boards.size() > 1 && on_every_board) return Origin::environment;
  if (shared.absent_in.empty()) return Origin::unclear;
  if (boards_seen.size() > 1) return Origin::unclear;
  // One board only: all of its axes that could show it, or one of them?
  const std::string& board = *boards_seen.begin();
  const auto on_this = [&](const std::string& place) { return place.rfind(board + "/", 0) == 0; };
  const bool missing_here = std::any_of(shared.absent_in.begin(), shared.absent_in.end(), on_this);
  if (missing_here) return Origin::axis;
  return boards.size() > 1 ? Origin::board : Origin::unclear;
}

std::string sentence_of(const SharedEffect& shared) {
  const std::string seen =
      fmt::format("{} shows on {}", shared.effect, fmt::join(shared.seen_in, ", "));
  const std::string absent = shared.absent_in.empty()
                                 ? ""
                                 : fmt::format(" and not on {}, which would have shown it",
                                               fmt::join(shared.absent_in, ", "));
  switch (shared.origin) {
    case Origin::environment:
      return seen + absent + ": all boards have it, so it comes from chamber, supply or room";
    case Origin::board:
      return seen + absent + ": it belongs to that board";
    case Origin::axis:
      return seen + absent + ": it belongs to that axis of the device";
    case Origin::unclear:
      return seen + absent + ": that does not tell environment from device";
  }
  return seen;
}

}  // namespace

std::string to_text(Origin origin) {
  switch (origin) {
    case Origin::environment:
      return "environment";
    case Origin::board:
      return "board";
    case Origin::axis:
      return "axis";
    case Origin::unclear:
      return "unclear";
  }
  return "unclear";
}

std::vector<SharedEffect> compare_boards(std::span<const AxisDiagnosis> diagnoses) {
  std::vector<SharedEffect> all;
  for (const Group& group : group(diagnoses)) {
    SharedEffect shared;
    shared.effect = group.example.effect;
    for (std::size_t i = 0; i < diagnoses.size(); ++i) {
      const bool shows = could_show(diagnoses[i].diagnosis, group.example, group.smallest);
      (group.seen.contains(i) ? shared.seen_in
       : shows                ? shared.absent_in
                              : shared.blind_in)
          .push_back(place_of(diagnoses[i]));
    }
    shared.origin = origin_of(diagnoses, group.seen, shared);
    shared.sentence = sentence_of(shared);
    all.push_back(std::move(shared));
  }
  std::stable_sort(all.begin(), all.end(), [](const SharedEffect& a, const SharedEffect& b) {
    return a.seen_in.size() > b.seen_in.size();
  });
  return all;
}

}  // namespace gyrocal
