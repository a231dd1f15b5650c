#include "daemon/cli/diagnosis_json.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

namespace gyrocal::cli {
namespace {

using Json = nlohmann::ordered_json;

/// JSON has no infinities: what is not a number is null.
Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json channel(const GapChannel& values) {
  return {{"before", number(values.before)}, {"after", number(values.after)}};
}

Json finding_json(const Finding& finding) {
  Json parameters = Json::object();
  for (const auto& [name, value] : finding.parameters) parameters[name] = number(value);
  return {{"effect", finding.effect},
          {"law", finding.law},
          {"amplitude", number(finding.amplitude)},
          {"unit", finding.unit},
          {"parameters", parameters},
          {"standard_error", number(finding.standard_error)},
          {"evidence_nats", number(finding.evidence_nats)},
          {"lead_nats", number(finding.lead_nats)},
          {"confounded_with", finding.confounded_with},
          {"tell_apart", finding.tell_apart},
          {"description", finding.description}};
}

}  // namespace

Json to_json(const Diagnosis& diagnosis) {
  Json json;
  json["format"] = "gyrocal-diagnosis/1";
  json["verdict"] = gyrocal::to_text(diagnosis.verdict);
  json["findings"] = Json::array();
  for (const Finding& finding : diagnosis.findings) {
    json["findings"].push_back(finding_json(finding));
  }
  const Gap& gap = diagnosis.gap;
  json["gap"] = {{"before", number(gap.before)},
                 {"after", number(gap.after)},
                 {"channels",
                  {{"slow_dps", channel(gap.slow_dps)},
                   {"spectrum", channel(gap.spectrum)},
                   {"distribution", channel(gap.distribution)},
                   {"link", channel(gap.link)},
                   {"slow", channel(gap.slow)},
                   {"spectrum_db", channel(gap.spectrum_db)},
                   {"distribution_share", channel(gap.distribution_share)},
                   {"link_share", channel(gap.link_share)}}},
                 {"held_out_dwells", gap.held_out_dwells}};
  json["gate_nats"] = number(diagnosis.gate_nats);
  json["detection_limits"] = Json::object();
  for (const auto& [name, limit] : diagnosis.detection_limits) {
    json["detection_limits"][name] = number(limit);
  }
  json["not_observable"] = diagnosis.not_observable;
  json["steps"] = Json::array();
  for (const GapStep& step : diagnosis.steps) {
    json["steps"].push_back({{"added", step.added}, {"gap", number(step.gap)}});
  }
  json["notes"] = diagnosis.notes;
  return json;
}

std::string to_text(const Diagnosis& diagnosis) {
  std::string text = fmt::format("verdict: {}\n", gyrocal::to_text(diagnosis.verdict));
  for (const Finding& finding : diagnosis.findings) {
    text += fmt::format("\n  {}\n", finding.description);
    if (!finding.confounded_with.empty()) {
      text += fmt::format("  could as well be: {}\n", fmt::join(finding.confounded_with, ", "));
      text += fmt::format("  to tell them apart: {}\n", finding.tell_apart);
    }
  }
  const Gap& gap = diagnosis.gap;
  if (!gap.held_out_dwells.empty()) {
    text += fmt::format(
        "\ngap on kept-out dwells {}: {:.2f} before, {:.2f} after (error bars beyond chance)\n"
        "  slow stream {:.2f} -> {:.2f} mdps, spectrum {:.2f} -> {:.2f} dB, spread {:.2f} -> "
        "{:.2f} "
        "%, frames lost {:.3f} -> {:.3f} %\n",
        fmt::join(gap.held_out_dwells, ", "), gap.before, gap.after, gap.slow_dps.before * 1000,
        gap.slow_dps.after * 1000, gap.spectrum_db.before, gap.spectrum_db.after,
        gap.distribution_share.before * 100, gap.distribution_share.after * 100,
        gap.link_share.before * 100, gap.link_share.after * 100);
  }
  text += "\nwould have been seen from this amplitude on:\n";
  for (const auto& [name, limit] : diagnosis.detection_limits) {
    text += fmt::format("  {:<30} {:.3g}\n", name, limit);
  }
  if (!diagnosis.not_observable.empty()) {
    text += fmt::format("not observable in this session: {}\n",
                        fmt::join(diagnosis.not_observable, ", "));
  }
  for (const std::string& note : diagnosis.notes) text += fmt::format("note: {}\n", note);
  return text;
}

Json to_json(std::span<const AxisDiagnosis> diagnoses, std::span<const SharedEffect> shared) {
  Json json = {{"format", "gyrocal-diagnosis-all/1"},
               {"diagnoses", Json::array()},
               {"shared", Json::array()}};
  for (const AxisDiagnosis& one : diagnoses) {
    json["diagnoses"].push_back(
        {{"board", one.board}, {"axis", one.axis}, {"diagnosis", to_json(one.diagnosis)}});
  }
  for (const SharedEffect& effect : shared) {
    json["shared"].push_back({{"effect", effect.effect},
                              {"origin", gyrocal::to_text(effect.origin)},
                              {"seen_in", effect.seen_in},
                              {"absent_in", effect.absent_in},
                              {"blind_in", effect.blind_in},
                              {"sentence", effect.sentence}});
  }
  return json;
}

std::string to_text(std::span<const AxisDiagnosis> diagnoses,
                    std::span<const SharedEffect> shared) {
  std::string text;
  for (const AxisDiagnosis& one : diagnoses) {
    text += fmt::format("{}/{}: {}, gap {:.2f} -> {:.2f}\n", one.board, one.axis,
                        gyrocal::to_text(one.diagnosis.verdict), one.diagnosis.gap.before,
                        one.diagnosis.gap.after);
    for (const Finding& finding : one.diagnosis.findings) {
      text += fmt::format("  {}\n", finding.description);
    }
  }
  if (!shared.empty()) text += "\n";
  for (const SharedEffect& effect : shared) text += effect.sentence + "\n";
  return text;
}

}  // namespace gyrocal::cli
