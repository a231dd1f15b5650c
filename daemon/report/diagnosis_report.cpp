#include "daemon/report/diagnosis_report.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "compensation/discrepancy/sample_rows.h"
#include "compensation/discrepancy/segments.h"
#include "compensation/rig/effects/catalogue.h"
#include "daemon/report/figure.h"
#include "daemon/report/gnuplot.h"
#include "daemon/report/page.h"

namespace gyrocal::report {
namespace {

std::string sentence_of(const Diagnosis& diagnosis) {
  std::vector<std::string> names;
  for (const Finding& finding : diagnosis.findings) names.push_back(finding.effect);
  const std::string found = fmt::format("{}", fmt::join(names, ", "));
  switch (diagnosis.verdict) {
    case Verdict::consistent:
      return "Nothing in this session that the rig model does not show, down to the limits below.";
    case Verdict::explained:
      return "What the rig model lacks has a name: " + found + ".";
    case Verdict::unexplained:
      return "Something is there that no effect of the catalogue describes: " + found + ".";
    case Verdict::confounded:
      return "On this plan more than one name explains it equally well: " + found + ".";
  }
  return {};
}

void add_findings(Page& page, const Diagnosis& diagnosis) {
  if (diagnosis.findings.empty()) return;
  page.heading("What was found");
  std::vector<std::vector<std::string>> rows;
  for (const Finding& finding : diagnosis.findings) {
    rows.push_back({finding.effect, finding.law, fmt::format("{:.4g}", finding.amplitude),
                    fmt::format("{:.2g}", finding.standard_error), finding.unit,
                    fmt::format("{:.1f}", finding.evidence_nats),
                    fmt::format("{:.1f}", finding.lead_nats),
                    fmt::format("{}", fmt::join(finding.confounded_with, ", "))});
  }
  page.table({"effect", "law", "amplitude", "standard error", "unit", "evidence, nats",
              "lead over the next name, nats", "could as well be"},
             rows);
  for (const Finding& finding : diagnosis.findings) {
    page.paragraph(finding.description);
    if (!finding.tell_apart.empty()) {
      page.paragraph("What would tell the names apart: " + finding.tell_apart + ".");
    }
  }
}

/// What was tried in the place of each finding of the slow stream.
void add_ranking(Page& page, const Diagnosis& diagnosis) {
  for (const Finding& finding : diagnosis.findings) {
    if (finding.candidates.empty()) continue;
    page.heading("What was held against " + finding.effect);
    page.paragraph(
        "Gain in log likelihood over the model without it, each in the same place, its shapes and "
        "the noise fitted anew; a name needs 5 nats more than any other.");
    std::vector<std::vector<std::string>> rows;
    const double best = finding.candidates.front().nats;
    for (const Candidate& candidate : finding.candidates) {
      rows.push_back({candidate.effect, candidate.law, fmt::format("{:.1f}", candidate.nats),
                      fmt::format("{:.1f}", best - candidate.nats), candidate.tell_apart});
    }
    page.table({"candidate", "law", "gain, nats", "behind the best, nats", "told apart by"}, rows);
  }
}

void add_gap(Page& page, const Diagnosis& diagnosis) {
  const Gap& gap = diagnosis.gap;
  if (gap.held_out_dwells.empty()) return;
  page.heading("How far the simulation is off, on dwells kept out of every fit");
  page.paragraph(fmt::format(
      "In its own error bars beyond chance: {:.2f} before, {:.2f} after (0: they agree to the "
      "noise). Dwells {}.",
      gap.before, gap.after, fmt::join(gap.held_out_dwells, ", ")));
  const auto row = [](const char* name, const GapChannel& channel, double scale) {
    return std::vector<std::string>{name, fmt::format("{:.3f}", channel.before * scale),
                                    fmt::format("{:.3f}", channel.after * scale)};
  };
  page.table(
      {"channel", "before", "after"},
      {row("slow stream, mdps", gap.slow_dps, to_mdps), row("spectrum, dB", gap.spectrum_db, 1),
       row("spread of the samples, %", gap.distribution_share, 100),
       row("frames lost, %", gap.link_share, 100)});
  std::vector<std::vector<std::string>> steps;
  for (const GapStep& step : diagnosis.steps) {
    steps.push_back({step.added.empty() ? "the model as given" : "with " + step.added,
                     fmt::format("{:.2f}", step.gap)});
  }
  page.table({"step", "gap"}, steps);
}

/// Columns of the predictions, thinned out where a row was not measured.
struct Course {
  std::vector<double> t_h, measured_dps, before_dps, after_dps;
  std::vector<double> off_before_mdps, off_after_mdps, chamber_c, rate_c_per_min;
};

/// Chamber temperature, or the board's where there is none; its slope over some minutes.
void add_temperatures(const Session& session, Course& course) {
  const auto& monitor = session.monitor;
  const auto temperature = [&](std::size_t i) {
    return std::isnan(monitor[i].chamber_c) ? monitor[i].board_c : monitor[i].chamber_c;
  };
  const auto reach = static_cast<std::size_t>(
      std::max(1.0, std::round(120 / std::max(session.monitor_interval_s, 1e-3))));
  for (std::size_t i = 0; i < monitor.size(); ++i) {
    const std::size_t from = i > reach ? i - reach : 0;
    const std::size_t to = std::min(i + reach, monitor.size() - 1);
    const double minutes = (monitor[to].t_s - monitor[from].t_s) / 60;
    course.chamber_c.push_back(temperature(i));
    course.rate_c_per_min.push_back(minutes > 0 ? (temperature(to) - temperature(from)) / minutes
                                                : 0);
  }
}

/// Mean of five minutes, so that a residual of mdps shows through noise of dps.
std::vector<double> smoothed(const std::vector<double>& values, std::size_t reach) {
  std::vector<double> means(values.size(), missing);
  double sum = 0, count = 0;
  for (std::size_t i = 0, end = 0, begin = 0; i < values.size(); ++i) {
    for (; end < std::min(values.size(), i + reach + 1); ++end) {
      if (!std::isnan(values[end])) sum += values[end], count += 1;
    }
    for (; begin + reach < i; ++begin) {
      if (!std::isnan(values[begin])) sum -= values[begin], count -= 1;
    }
    if (count > 0) means[i] = sum / count;
  }
  return means;
}

Course course_of(const Session& session, const Diagnosis& diagnosis) {
  Course course;
  for (const PredictionRow& row : diagnosis.prediction) {
    course.t_h.push_back(row.t_s / 3600);
    course.measured_dps.push_back(row.measured_dps);
    course.before_dps.push_back(row.before_dps);
    course.after_dps.push_back(row.after_dps);
    course.off_before_mdps.push_back((row.measured_dps - row.before_dps) * to_mdps);
    course.off_after_mdps.push_back((row.measured_dps - row.after_dps) * to_mdps);
  }
  const auto reach = static_cast<std::size_t>(
      std::max(1.0, std::round(150 / std::max(session.monitor_interval_s, 1e-3))));
  course.measured_dps = smoothed(course.measured_dps, reach);
  course.off_before_mdps = smoothed(course.off_before_mdps, reach);
  course.off_after_mdps = smoothed(course.off_after_mdps, reach);
  add_temperatures(session, course);
  return course;
}

std::vector<std::pair<double, double>> kept_out_h(const Session& session) {
  std::vector<std::pair<double, double>> ranges;
  for (const Segment& segment : split_segments(session)) {
    if (segment.held_out) ranges.emplace_back(segment.begin_s / 3600, segment.end_s / 3600);
  }
  return ranges;
}

/// Residuals over temperature, rising and falling apart: what depends on direction stands out.
Figure over_temperature(const Course& course, const std::vector<double>& off_mdps,
                        const char* title) {
  constexpr double still_c_per_min = 0.05;
  Curve rising{"rising", Curve::Style::points, {}, {}, {}, 1};
  Curve falling{"falling", Curve::Style::points, {}, {}, {}, 0};
  Curve still{"at rest", Curve::Style::points, {}, {}, {}, 4};
  for (std::size_t i = 0; i < off_mdps.size(); i += 1 + off_mdps.size() / 3000) {
    const double rate = course.rate_c_per_min[i];
    Curve& curve = std::abs(rate) < still_c_per_min ? still : rate > 0 ? rising : falling;
    curve.x.push_back(course.chamber_c[i]);
    curve.y.push_back(off_mdps[i]);
  }
  return {title, "chamber temperature, degC", "measured - simulated, mdps", false, false,
          {},    {still, rising, falling}};
}

Result<void> add_figures(Page& page, const Session& session, const Diagnosis& diagnosis) {
  const Course course = course_of(session, diagnosis);
  const auto kept_out = kept_out_h(session);
  page.heading("Measured and simulated");
  const std::vector<std::pair<Figure, const char*>> figures{
      {{"Rate over time",
        "time, h",
        "rate, dps",
        false,
        false,
        kept_out,
        {{"measured, mean of 5 min", Curve::Style::line, course.t_h, course.measured_dps, {}, 4},
         {"simulated before", Curve::Style::line, course.t_h, course.before_dps, {}, 1},
         {"simulated after", Curve::Style::line, course.t_h, course.after_dps, {}, 0}}},
       "Grey: ramps, soaks and dwells kept out of every fit."},
      {{"What is left over time",
        "time, h",
        "measured - simulated, mdps",
        false,
        false,
        kept_out,
        {{"before", Curve::Style::line, course.t_h, course.off_before_mdps, {}, 1},
         {"after", Curve::Style::line, course.t_h, course.off_after_mdps, {}, 0}}},
       "Means of 5 min."},
      {over_temperature(course, course.off_before_mdps, "What is left over temperature, before"),
       "By the direction of the chamber's temperature."},
      {over_temperature(course, course.off_after_mdps, "What is left over temperature, after"),
       "By the direction of the chamber's temperature."},
  };
  for (const auto& [figure, caption] : figures) {
    const auto svg = svg_of(figure);
    if (!svg) return tl::unexpected(svg.error());
    page.figure(*svg, caption);
  }
  return {};
}

Result<void> add_spectra(Page& page, const Diagnosis& diagnosis) {
  if (diagnosis.spectrum.empty()) return {};
  Curve measured{"measured", Curve::Style::line, {}, {}, {}, 4};
  Curve before{"simulated before", Curve::Style::line, {}, {}, {}, 1};
  Curve after{"simulated after", Curve::Style::line, {}, {}, {}, 0};
  for (const SpectrumRow& row : diagnosis.spectrum) {
    for (Curve* curve : {&measured, &before, &after}) curve->x.push_back(row.f_hz);
    measured.y.push_back(std::sqrt(row.measured) * to_mdps);
    before.y.push_back(std::sqrt(row.before) * to_mdps);
    after.y.push_back(std::sqrt(row.after) * to_mdps);
  }
  const auto svg = svg_of({"Spectra of the kept-out dwells",
                           "frequency, Hz",
                           "density, mdps/rtHz",
                           false,
                           true,
                           {},
                           {measured, before, after}});
  if (!svg) return tl::unexpected(svg.error());
  page.heading("Spectra");
  page.figure(*svg, "Mean over the dwells kept out of every fit.");
  return {};
}

void add_limits(Page& page, const Diagnosis& diagnosis) {
  page.heading("What would have been seen");
  page.paragraph("Smallest amplitude of each effect that would have passed the gate here.");
  std::vector<std::vector<std::string>> rows;
  for (const auto& [name, limit] : diagnosis.detection_limits) {
    const rig::Effect* const effect = rig::find_effect(name);
    rows.push_back(
        {name, fmt::format("{:.3g}", limit),
         effect == nullptr ? "" : std::string(effect->laws.front()->info.parameters.front().unit)});
  }
  page.table({"effect", "from", "unit"}, rows);
  if (!diagnosis.not_observable.empty()) {
    page.paragraph(fmt::format("Not observable in this session: {}.",
                               fmt::join(diagnosis.not_observable, ", ")));
  }
}

}  // namespace

Result<std::string> diagnosis_report(const Session& session, const Diagnosis& diagnosis,
                                     const DiagnosisSource& source) {
  Page page("Diagnosis of " + source.session);
  page.banner(to_text(diagnosis.verdict), sentence_of(diagnosis));
  add_findings(page, diagnosis);
  add_ranking(page, diagnosis);
  add_gap(page, diagnosis);
  const auto stand_in = stand_in_for(session);
  auto drawn = add_figures(page, stand_in ? *stand_in : session, diagnosis);
  if (drawn) drawn = add_spectra(page, diagnosis);
  if (!drawn) return tl::unexpected(drawn.error());
  add_limits(page, diagnosis);
  if (!diagnosis.notes.empty()) page.heading("Notes");
  page.list(diagnosis.notes);
  page.paragraph(
      fmt::format("Rig model {}; gyrocal {}.", source.rig_model, source.software_version));
  return page.finish();
}

}  // namespace gyrocal::report
