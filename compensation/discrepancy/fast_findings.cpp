#include "compensation/discrepancy/fast_findings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "compensation/discrepancy/dwell_shape.h"
#include "compensation/discrepancy/slow_story.h"

namespace gyrocal {
namespace {

constexpr double gated = 0.5;  // correlation of a line's power with the chamber's cooling
// Two levels that owe nearly all they gain to their spectrum are a noise of that spectrum. Levels
// less than a deviation apart owe it more: their lead goes with the fourth power of the distance,
// what their spectrum gains with the square.
constexpr double telegraph_lead_share = 0.12;

Finding finding(const char* effect, const char* law, double amplitude, const char* unit, double sd,
                double nats) {
  Finding made;
  made.effect = effect;
  made.law = law;
  made.amplitude = amplitude;
  made.unit = unit;
  made.standard_error = sd;
  made.evidence_nats = nats;
  made.lead_nats = nats;
  return made;
}

struct Band {
  double low_hz, high_hz;
};

constexpr Band rotors[] = {{23.7, 25.3}, {28.4, 29.7}, {47.4, 49.65}, {56.8, 59.4}};
constexpr double mains_hz[] = {50, 60};

bool folds_into(const SpectralLine& line, Band band, double sample_rate_hz) {
  // A band can straddle the folding frequency: try it in small steps.
  for (double f = band.low_hz; f <= band.high_hz; f += 0.05) {
    if (std::abs(folded_hz(f, sample_rate_hz) - line.f_hz) < 0.05 + line.width_hz / 2) return true;
  }
  return false;
}

struct MainsMatch {
  double grid_hz = 0;
  int harmonic = 1;
};

/// The grid whose first or second harmonic could appear here; clocks may be off by 0.3 %.
std::optional<MainsMatch> mains_match(double f_hz, double width_hz, double sample_rate_hz) {
  for (const double grid_hz : mains_hz) {
    for (const int harmonic : {1, 2}) {
      const double true_hz = grid_hz * harmonic;
      const double tolerance = 0.05 + 0.003 * true_hz + width_hz / 2;
      if (std::abs(folded_hz(true_hz, sample_rate_hz) - f_hz) < tolerance) {
        return MainsMatch{grid_hz, harmonic};
      }
    }
  }
  return std::nullopt;
}

double line_sd(const FastEvidence& evidence) {
  const DwellSpectrum& spectrum = evidence.spectrum;
  return std::sqrt(2 * spectrum.density_dps2 /
                   (static_cast<double>(spectrum.samples) * spectrum.dwells));
}

Finding name_line(const SpectralLine& line, const FastEvidence& evidence, double sample_rate_hz) {
  const double mdps = line.amplitude_dps * 1000;
  const double sd = line_sd(evidence) * 1000;
  const auto mains = mains_match(line.f_hz, line.width_hz, sample_rate_hz);
  const bool rotor = std::any_of(std::begin(rotors), std::end(rotors),
                                 [&](Band band) { return folds_into(line, band, sample_rate_hz); });
  const bool follows_cooling = line.gating > gated;
  const auto compressor = [&] {
    // The line is there only while the compressor runs: its power in dwells that have it.
    const double a = 1000 * line.amplitude_when_on_dps;
    Finding made = finding("compressor_vibration", "line", a, "mdps", sd * a / mdps, line.nats);
    made.parameters = {{"a", a}, {"f", line.f_hz}, {"acc", 0.0}};
    return made;
  };
  const auto hum = [&] {
    Finding made = finding("mains_hum", "steady", mdps, "mdps", sd, line.nats);
    made.parameters = {{"a", mdps}, {"f", mains->grid_hz}, {"clock", 0.0}, {"second", 0.0}};
    return made;
  };
  if (mains && rotor) {
    Finding made = follows_cooling ? compressor() : hum();
    made.confounded_with = {follows_cooling ? "mains_hum" : "compressor_vibration"};
    made.lead_nats = 0;
    return made;
  }
  if (mains) return hum();
  if (rotor || follows_cooling) return compressor();
  Finding made = finding("unknown", "line", line.amplitude_dps, "dps", sd / 1000, line.nats);
  made.parameters = {{"f_hz", line.f_hz}};
  made.description = fmt::format(
      "a line at {:.4g} Hz of {:.3g} mdps in the dwells' spectrum; it is at no alias of the mains "
      "or of a compressor, and its power does not follow the chamber's cooling (correlation "
      "{:+.2f})",
      line.f_hz, mdps, line.gating);
  return made;
}

double dwell_length_s(const FastEvidence& evidence) {
  // Two fine bins are one over the length of a dwell.
  return 1 / (2 * evidence.spectrum.bin_hz);
}

/// Lines of one cause become one finding, led by the strongest; a grid's second harmonic is told
/// as a share of the first.
void add_lines(const FastEvidence& evidence, double sample_rate_hz, std::vector<Finding>& found) {
  const bool coloured =
      std::max(evidence.colour.relax_nats, evidence.colour.flicker_nats) > gate_nats;
  for (const SpectralLine& line : evidence.lines) {
    // The foot of coloured noise is no line.
    if (line.f_hz < (coloured ? 1.0 : 6 / dwell_length_s(evidence))) continue;
    Finding next = name_line(line, evidence, sample_rate_hz);
    const auto same = std::find_if(found.begin(), found.end(), [&](const Finding& other) {
      return other.effect == next.effect && other.effect != "unknown";
    });
    if (same == found.end()) {
      found.push_back(std::move(next));
      continue;
    }
    same->evidence_nats += next.evidence_nats;
    same->lead_nats += next.lead_nats;
    if (next.effect == "mains_hum") same->parameters[3].second = next.amplitude / same->amplitude;
  }
}

void add_telegraph(const FastEvidence& evidence, std::vector<Finding>& found) {
  const TelegraphFit& fit = evidence.telegraph;
  // Repeated samples are alike for a while too, and lose nothing by being called a level.
  if (fit.nats < gate_nats || evidence.codes.stuck_nats > gate_nats) return;
  Finding made = finding("random_telegraph_noise", "two_levels", fit.level_dps * 1000, "mdps",
                         fit.level_sd_dps * 1000, fit.nats);
  made.parameters = {{"a", fit.level_dps * 1000},
                     {"low", fit.low_dwell_s},
                     {"high", fit.high_dwell_s},
                     {"ea", 0.0}};
  // Two levels must do better than any Gaussian noise of a like spectrum. What such noise explains
  // as well, the slow stream shows too and names.
  made.lead_nats = std::min({fit.nats, fit.lead_nats, fit.flicker_lead_nats});
  const double apart = std::min(1.0, fit.level_dps / fit.white_sd_dps);
  const double share = telegraph_lead_share * apart * apart;
  if (made.lead_nats < std::max(lead_to_name_nats, share * fit.nats)) return;
  found.push_back(std::move(made));
}

void add_codes(const CodeFindings& codes, std::vector<Finding>& found) {
  if (codes.holes_nats > gate_nats) {
    Finding made = finding("missing_codes", "periodic", codes.holes_share, "1",
                           codes.holes_share_sd, codes.holes_nats);
    const double first = static_cast<double>(codes.holes.front());
    double period = 0;
    for (std::size_t i = 1; i < codes.holes.size(); ++i) {
      const auto step = static_cast<double>(codes.holes[i] - codes.holes[i - 1]);
      period = period == 0 ? step : std::min(period, step);
    }
    const double span = static_cast<double>(codes.holes.back() - codes.holes.front());
    if (codes.holes.size() > 1 && period >= 2 &&
        span / period + 1 == static_cast<double>(codes.holes.size())) {
      // Holes at one distance are a bit of the converter: then the share is known exactly.
      made.amplitude = 1 / period;
      made.parameters = {{"share", made.amplitude},
                         {"phase", first - period * std::floor(first / period)}};
    } else {
      made.law = "single";
      for (const std::int64_t hole : codes.holes) {
        made.parameters.emplace_back("code", static_cast<double>(hole));
      }
    }
    std::string list;
    for (std::size_t i = 0; i < codes.holes.size() && i < 12; ++i) {
      list += fmt::format("{}{}", i == 0 ? "" : ", ", codes.holes[i]);
    }
    made.description = fmt::format("codes that never come though they should: {}", list);
    found.push_back(std::move(made));
  }
  for (const bool upper : {true, false}) {
    const double nats = upper ? codes.upper_nats : codes.lower_nats;
    const double rail = upper ? codes.upper_dps : codes.lower_dps;
    if (nats <= gate_nats) continue;
    Finding made =
        finding("saturation", upper ? "upper" : "lower", rail, "dps", std::abs(rail) * 1e-3, nats);
    made.parameters = {{upper ? "hi" : "lo", rail}};
    found.push_back(std::move(made));
  }
  if (codes.outlier_nats > gate_nats) {
    Finding made = finding("outlier_glitches", codes.outliers_one_sided ? "one_sided" : "symmetric",
                           codes.outlier_share, "1", codes.outlier_share_sd, codes.outlier_nats);
    made.parameters = {{"p", codes.outlier_share}, {"size", codes.outlier_size_sigma}};
    found.push_back(std::move(made));
  }
  if (codes.stuck_nats > gate_nats) {
    Finding made = finding("stuck_samples", "runs", codes.stuck_share, "1", codes.stuck_share_sd,
                           codes.stuck_nats);
    made.parameters = {{"share", codes.stuck_share}, {"length", codes.stuck_length}};
    found.push_back(std::move(made));
  }
  // A rail or holes change the spread wherever the mean comes near them.
  const bool bent =
      codes.holes_nats > gate_nats || codes.upper_nats > gate_nats || codes.lower_nats > gate_nats;
  if (codes.spread_nats > gate_nats && !bent) {
    Finding made =
        finding("noise_temperature_dependence", "exponential", codes.spread_percent_per_c, "%/degC",
                codes.spread_sd, codes.spread_nats);
    made.parameters = {{"s1", codes.spread_percent_per_c}};
    found.push_back(std::move(made));
  }
  if (codes.growth_nats > gate_nats && !bent) {
    Finding made = finding("unknown", "spread_over_time", codes.growth_percent_per_h, "%/h",
                           codes.growth_sd, codes.growth_nats);
    made.parameters = {{"percent_per_h", codes.growth_percent_per_h}, {"middle_h", codes.middle_h}};
    made.description = fmt::format(
        "the samples' white noise changes by {:+.3g} % an hour, whatever the temperature ({:.1f} "
        "nats over what temperature alone explains)",
        codes.growth_percent_per_h, codes.growth_nats);
    found.push_back(std::move(made));
  }
  if (codes.lost_nats > gate_nats) {
    const double share = static_cast<double>(codes.lost) / static_cast<double>(codes.expected);
    Finding made =
        finding("dropped_samples", codes.lost_burst > 1.5 ? "bursts" : "independent", share, "1",
                std::sqrt(static_cast<double>(codes.lost) * codes.lost_burst) /
                    static_cast<double>(codes.expected),
                codes.lost_nats);
    made.parameters = {{"share", share}};
    if (codes.lost_burst > 1.5) made.parameters.push_back({"length", codes.lost_burst});
    found.push_back(std::move(made));
  }
}

/// The excess over 1 of a mean of `degrees` unit exponentials that is worth `nats`.
double excess_for(double nats, double degrees) {
  double low = 0, high = 1;
  while (degrees * (high - std::log1p(high)) < nats) high *= 2;
  for (int i = 0; i < 60; ++i) {
    const double middle = (low + high) / 2;
    (degrees * (middle - std::log1p(middle)) < nats ? low : high) = middle;
  }
  return high;
}

/// The upper rail beyond which too few samples would have come to be missed [deg/s].
double highest_rail_seen(const FastEvidence& evidence) {
  const double sd = evidence.codes.white_sd_dps;
  const auto missed = [&](double rail_dps) {
    double beyond = 0;
    for (const DwellData& dwell : evidence.dwells) {
      beyond += static_cast<double>(dwell.y_dps.size()) * 0.5 *
                std::erfc((rail_dps - dwell.mean_dps) / (sd * std::numbers::sqrt2));
    }
    return beyond;
  };
  double low = 1e300, high = -1e300;
  for (const DwellData& dwell : evidence.dwells) {
    low = std::min(low, dwell.mean_dps);
    high = std::max(high, dwell.mean_dps + 10 * sd);
  }
  for (int i = 0; i < 60; ++i) {
    const double middle = (low + high) / 2;
    (missed(middle) > gate_nats ? low : high) = middle;
  }
  return low;
}

/// Dwells that a rail has not flattened: where next to all samples are alike, those few that are
/// not make a spectrum of their own.
std::vector<DwellData> with_noise(const std::vector<DwellData>& dwells) {
  constexpr double flat_share = 0.25;
  std::vector<double> sd_dps;
  for (const DwellData& dwell : dwells) sd_dps.push_back(white_sd_dps(dwell, 0));
  std::vector<double> sorted = sd_dps;
  std::sort(sorted.begin(), sorted.end());
  const double usual_dps = sorted[sorted.size() * 3 / 4];
  std::vector<DwellData> kept;
  for (std::size_t d = 0; d < dwells.size(); ++d) {
    if (sd_dps[d] >= flat_share * usual_dps) kept.push_back(dwells[d]);
  }
  return kept;
}

}  // namespace

FastEvidence gather_fast_evidence(const Session& session, std::span<const Segment> segments,
                                  const Track& track) {
  FastEvidence evidence;
  evidence.dwells = dwell_data(session, segments, track, false);
  if (evidence.dwells.empty()) return evidence;
  const auto noisy = with_noise(evidence.dwells);
  evidence.spectrum = dwell_spectrum(noisy, session.sample_rate_hz);
  evidence.lines = find_lines(evidence.spectrum, noisy, gate_nats);
  evidence.colour = dwell_colour(evidence.spectrum);
  if (evidence.colour.relax_nats > gate_nats - 4) {
    evidence.telegraph = fit_telegraph(noisy, session.sample_rate_hz);
  }
  evidence.codes =
      inspect_codes(evidence.dwells, session.lsb_dps, evidence.telegraph.nats > gate_nats);
  return evidence;
}

std::vector<Finding> fast_findings(const FastEvidence& evidence, double sample_rate_hz) {
  std::vector<Finding> found;
  if (evidence.dwells.empty()) return found;
  add_lines(evidence, sample_rate_hz, found);
  add_telegraph(evidence, found);
  add_codes(evidence.codes, found);
  return found;
}

std::map<std::string, double> fast_limits(const FastEvidence& evidence) {
  std::map<std::string, double> limits;
  if (evidence.dwells.empty()) return limits;
  double samples = 0, spread = 0, mean_c = 0;
  const auto dwells = static_cast<double>(evidence.dwells.size());
  for (const DwellData& dwell : evidence.dwells) {
    samples += static_cast<double>(dwell.y_dps.size());
    mean_c += dwell.die_c / dwells;
  }
  for (const DwellData& dwell : evidence.dwells) {
    spread += std::pow(dwell.die_c - mean_c, 2) * static_cast<double>(dwell.y_dps.size());
  }
  const DwellSpectrum& spectrum = evidence.spectrum;
  if (!spectrum.mean.empty()) {
    const double nats = gate_nats + 1 + std::log(static_cast<double>(spectrum.mean.size()));
    const double excess = excess_for(nats, spectrum.dwells);
    const double line = 1000 * std::sqrt(4 * excess * spectrum.density_dps2 /
                                         static_cast<double>(spectrum.samples));
    limits["mains_hum"] = line;
    limits["compressor_vibration"] = line;
  }
  // A telegraph of half a deviation and 2 s gains 3 nats a minute at 50 Hz; it goes with A^4.
  limits["random_telegraph_noise"] =
      1000 * evidence.codes.white_sd_dps * 0.5 * std::pow(gate_nats * 3000 / (3.0 * samples), 0.25);
  limits["outlier_glitches"] = 1 / samples;
  limits["stuck_samples"] = 10 / samples;
  limits["dropped_samples"] = 3 / samples;
  if (evidence.codes.quantised) {
    limits["saturation"] = highest_rail_seen(evidence);
    if (evidence.codes.testable > 0) limits["missing_codes"] = 1.0 / evidence.codes.testable;
  }
  if (spread > 0) {
    limits["noise_temperature_dependence"] = 100 * std::sqrt(2 * gate_nats * 0.75 / spread);
  }
  return limits;
}

}  // namespace gyrocal
