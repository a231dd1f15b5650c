#include "compensation/discrepancy/verdict.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "compensation/rig/effects/catalogue.h"

namespace gyrocal {
namespace {

/// A sensor rounds, floors or truncates as its maker liked: half a step is no error.
double rounding_margin_c(const BoardSensorFit& fit) { return std::max(0.1, 0.55 * fit.step_c); }

constexpr double standard_errors_needed = 4.5;  // half its square is the gate in nats

std::string unit_of(const rig::Law& law) { return std::string(law.info.parameters[0].unit); }

std::string number_with_unit(double value, const std::string& unit) {
  return unit == "1" ? fmt::format("{:.3g}", value) : fmt::format("{:.4g} {}", value, unit);
}

std::string tell_apart(const rig::Effect& effect, const std::vector<std::string>& rivals) {
  std::string text;
  for (const std::string& rival : rivals) {
    for (const rig::Confusion& confusion : effect.confused_with) {
      if (confusion.effect != rival) continue;
      text += fmt::format("{}{}: {}", text.empty() ? "" : "; ", rival, confusion.tell_apart);
    }
  }
  if (text.empty() && !rivals.empty()) {
    text = "revisit three or four setpoints at the end and reverse the sweep (gyrocal plan)";
  }
  return text;
}

}  // namespace

std::string to_text(Verdict verdict) {
  switch (verdict) {
    case Verdict::consistent:
      return "consistent";
    case Verdict::explained:
      return "explained";
    case Verdict::unexplained:
      return "unexplained";
    case Verdict::confounded:
      return "confounded";
  }
  return "unexplained";
}

std::vector<Finding> to_findings(const std::vector<SlowFinding>& story) {
  std::vector<Finding> findings;
  for (const SlowFinding& slow : story) {
    Finding finding;
    finding.effect = slow.effect;
    finding.law = slow.law;
    finding.amplitude = slow.amplitude;
    finding.standard_error = slow.amplitude_sd;
    finding.parameters = slow.parameters;
    finding.unit = "dps";
    finding.evidence_nats = slow.evidence_nats;
    finding.lead_nats = slow.lead_nats;
    finding.confounded_with = slow.rivals;
    finding.description = slow.description;
    for (const SlowRank& rank : slow.ranking) {
      finding.candidates.push_back({rank.effect, rank.law, rank.nats, ""});
    }
    if (slow.term) {
      finding.parameters.clear();
      for (std::size_t i = 0; i < slow.term->values.size(); ++i) {
        finding.parameters.emplace_back(slow.term->law->info.parameters[i].name,
                                        slow.term->values[i]);
      }
    }
    if (const rig::Effect* effect = rig::find_effect(slow.effect)) {
      const rig::Law* law = rig::find_law(*effect, slow.law);
      finding.unit = unit_of(law != nullptr ? *law : *effect->laws.front());
      if (!slow.term)
        finding.parameters.insert(
            finding.parameters.begin(),
            {std::string(effect->laws.front()->info.parameters[0].name), slow.amplitude});
    }
    if (slow.effective_amplitude != 0) {
      finding.standard_error *= std::abs(slow.effective_amplitude / finding.amplitude);
      finding.amplitude = slow.effective_amplitude;
    }
    findings.push_back(std::move(finding));
  }
  return findings;
}

std::optional<Finding> sensor_finding(const BoardSensorFit& fit) {
  if (!fit.observed) return std::nullopt;
  const double offset_excess = std::abs(fit.offset_c) - rounding_margin_c(fit);
  const double gain_span_c = 30;
  const double gain_excess =
      std::abs(fit.gain) * gain_span_c - std::max(rounding_margin_c(fit), 0.2);
  const bool offset =
      offset_excess > 0 && std::abs(fit.offset_c) > standard_errors_needed * fit.offset_sd_c;
  const bool gain = gain_excess > 0 && std::abs(fit.gain) > standard_errors_needed * fit.gain_sd;
  if (!offset && !gain) return std::nullopt;
  Finding finding;
  finding.effect = "board_sensor_offset";
  const bool as_gain = gain && std::abs(fit.gain) * gain_span_c > std::abs(fit.offset_c);
  finding.law = as_gain ? "gain" : "offset";
  finding.unit = as_gain ? "degC/degC" : "degC";
  finding.amplitude = as_gain ? fit.gain : fit.offset_c;
  finding.standard_error = as_gain ? fit.gain_sd : fit.offset_sd_c;
  const double z = finding.amplitude / std::max(finding.standard_error, 1e-9);
  finding.evidence_nats = std::max(gate_nats, std::min(0.5 * z * z, fit.nats));
  finding.lead_nats = finding.evidence_nats;
  finding.parameters = {{as_gain ? "e" : "d", finding.amplitude}};
  return finding;
}

void add_sensor_limit(const BoardSensorFit& fit, std::map<std::string, double>& limits) {
  if (!fit.observed) return;
  limits["board_sensor_offset"] =
      std::max(rounding_margin_c(fit), standard_errors_needed * fit.offset_sd_c);
}

void explain(std::vector<Finding>& findings) {
  for (Finding& finding : findings) {
    const rig::Effect* effect = rig::find_effect(finding.effect);
    if (effect == nullptr) continue;
    finding.tell_apart = tell_apart(*effect, finding.confounded_with);
    for (Candidate& candidate : finding.candidates) {
      for (const rig::Confusion& confusion : effect->confused_with) {
        if (confusion.effect == candidate.effect) candidate.tell_apart = confusion.tell_apart;
      }
    }
    std::string text = fmt::format(
        "{} ({}): {} +- {:.2g}, {:.1f} nats over the model without it and {:.1f} over the best "
        "other name.",
        finding.effect, finding.law, number_with_unit(finding.amplitude, finding.unit),
        finding.standard_error, finding.evidence_nats, finding.lead_nats);
    text += fmt::format(" {}", effect->physics);
    if (!finding.description.empty()) text += fmt::format(" Here: {}.", finding.description);
    finding.description = std::move(text);
  }
}

Verdict verdict_of(const std::vector<Finding>& findings) {
  if (findings.empty()) return Verdict::consistent;
  const auto unknown = [](const Finding& finding) { return finding.effect == "unknown"; };
  if (std::any_of(findings.begin(), findings.end(), unknown)) return Verdict::unexplained;
  const auto open = [](const Finding& finding) { return !finding.confounded_with.empty(); };
  if (std::any_of(findings.begin(), findings.end(), open)) return Verdict::confounded;
  return Verdict::explained;
}

}  // namespace gyrocal
