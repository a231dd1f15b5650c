#include "daemon/report/campaign_figures.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "compensation/drift/allan.h"
#include "compensation/drift/allan_pieces.h"
#include "daemon/report/figure.h"
#include "daemon/runner/analysis.h"

namespace gyrocal::report {
namespace {

std::vector<std::pair<double, double>> dwells_h(const CampaignFacts& facts) {
  std::vector<std::pair<double, double>> ranges;
  for (const DwellRow& dwell : facts.dwells) {
    if (dwell.reject_reason || dwell.board != facts.boards.front().id) continue;
    ranges.emplace_back(1e-9 * double(dwell.t_start_ns) / 3600,
                        1e-9 * double(dwell.t_end_ns) / 3600);
  }
  return ranges;
}

std::string name_of_axis(const BoardFacts& board, const AxisFacts& axis) {
  return fmt::format("{}_{}", board.board.name, letter(axis.axis));
}

std::string title_of_axis(const BoardFacts& board, const AxisFacts& axis) {
  return fmt::format("board {}, axis {}", board.board.name, letter(axis.axis));
}

/// Raw rates of the first dwell, and the instants [s].
Curve first_dwell(const AxisFacts& axis) {
  Curve raw{"raw", Curve::Style::line, {}, {}, {}, 6};
  if (axis.session.dwells.empty()) return raw;
  const auto dwell = axis.session.dwells.front().dwell;
  for (const SessionSample& sample : axis.session.samples) {
    if (sample.dwell != dwell || std::isnan(sample.gyro_dps)) continue;
    raw.x.push_back(double(sample.seq) / axis.session.sample_rate_hz);
    raw.y.push_back(sample.gyro_dps);
  }
  return raw;
}

void add_dwell(const CampaignFacts& facts, const BoardFacts& board, const AxisFacts& axis,
               std::vector<NamedFigure>& figures) {
  const Curve raw = first_dwell(axis);
  const auto settings = runner::denoise_settings(facts.config.analysis);
  if (raw.x.empty() || !settings) return;
  const auto filtered = denoise(raw.y, *settings);
  if (!filtered) return;
  const Curve smooth{"filtered", Curve::Style::line, raw.x, filtered->denoised, {}, 1};
  figures.push_back(
      {name_of_axis(board, axis) + "_dwell",
       fmt::format("Filter: {}, {}, level {}, {}.", facts.config.analysis.wavelet,
                   facts.config.analysis.mode, facts.config.analysis.level,
                   facts.config.analysis.rule),
       {fmt::format("The dwell at {} degC, raw and filtered: {}",
                    axis.session.dwells.front().setpoint_c, title_of_axis(board, axis)),
        "time, s",
        "rate, dps",
        false,
        false,
        {},
        {raw, smooth}}});
}

Curve curve_over(const ModelFacts& model, int colour) {
  Curve curve{model.row.method, Curve::Style::line, {}, {}, {}, colour};
  const auto& setpoints = model.curve.axis.setpoints_c;
  constexpr int steps = 200;
  for (int i = 0; i <= steps; ++i) {
    const double t = setpoints.front() + (setpoints.back() - setpoints.front()) * i / steps;
    curve.x.push_back(t);
    curve.y.push_back(model.curve.at({t}));
  }
  return curve;
}

void add_drift(const BoardFacts& board, const AxisFacts& axis, std::vector<NamedFigure>& figures) {
  if (axis.models.empty()) return;
  Figure drift{fmt::format("Zero drift over temperature: {}", title_of_axis(board, axis)),
               "temperature, degC",
               "zero drift, dps",
               false,
               false,
               {},
               {}};
  Figure left{fmt::format("What the models leave: {}", title_of_axis(board, axis)),
              "temperature, degC",
              "measured - model, mdps",
              false,
              false,
              {},
              {}};
  int colour = 0;
  for (const ModelFacts& model : axis.models) {
    const bool paper = colour < 3;  // its three methods come first
    if (model.row.recommended) {
      Curve band{"95 % band of " + model.row.method, Curve::Style::band, {}, {}, {}, 2};
      for (const ModelPoint& point : model.row.points) {
        band.x.push_back(point.temperature_c);
        band.y.push_back(point.fitted_dps - point.band_dps);
        band.upper.push_back(point.fitted_dps + point.band_dps);
      }
      drift.curves.insert(drift.curves.begin(), band);
    }
    if (paper || model.row.recommended) {
      drift.curves.push_back(curve_over(model, colour));
      Curve residual{model.row.method, Curve::Style::line, {}, {}, {}, colour};
      for (const ModelPoint& point : model.row.points) {
        residual.x.push_back(point.temperature_c);
        residual.y.push_back((point.measured_dps - point.fitted_dps) * to_mdps);
      }
      left.curves.push_back(std::move(residual));
    }
    ++colour;
  }
  Curve measured{"measured", Curve::Style::points, {}, {}, {}, 4};
  for (const ModelPoint& point : axis.models.front().row.points) {
    measured.x.push_back(point.temperature_c);
    measured.y.push_back(point.measured_dps);
  }
  drift.curves.push_back(std::move(measured));
  figures.push_back({name_of_axis(board, axis) + "_drift",
                     "The paper's three methods, the recommended model and its prediction band.",
                     std::move(drift)});
  figures.push_back({name_of_axis(board, axis) + "_residual",
                     "On the setpoints the models were fitted to.", std::move(left)});
}

void add_allan(const BoardFacts& board, const AxisFacts& axis, std::vector<NamedFigure>& figures) {
  const auto pieces = unbroken_pieces(axis.session.samples, std::nullopt);
  const std::vector<std::span<const double>> spans(pieces.begin(), pieces.end());
  if (spans.empty()) return;
  const auto points =
      overlapping_allan(spans, axis.session.sample_rate_hz, allan_factors(longest_of(spans), 8));
  if (!points) return;
  Curve band{"95 % interval", Curve::Style::band, {}, {}, {}, 0};
  Curve curve{"Allan deviation", Curve::Style::line, {}, {}, {}, 0};
  for (const AllanPoint& point : *points) {
    if (point.deviation <= 0) continue;
    for (Curve* one : {&band, &curve}) one->x.push_back(point.tau_s);
    curve.y.push_back(point.deviation);
    band.y.push_back(point.deviation_low);
    band.upper.push_back(point.deviation_high);
  }
  figures.push_back({name_of_axis(board, axis) + "_allan",
                     "Over all accepted dwells.",
                     {fmt::format("Allan deviation: {}", title_of_axis(board, axis)),
                      "averaging time, s",
                      "deviation, dps",
                      true,
                      true,
                      {},
                      {band, curve}}});
}

}  // namespace

NamedFigure temperature_figure(const CampaignFacts& facts) {
  Figure figure{
      "Temperatures of the campaign", "time, h", "temperature, degC", false, false, {}, {}};
  if (facts.boards.empty() || facts.boards.front().axes.empty())
    return {"temperatures", "", figure};
  figure.marked = dwells_h(facts);
  Curve setpoint{"setpoint", Curve::Style::line, {}, {}, {}, 4};
  Curve chamber{"chamber", Curve::Style::line, {}, {}, {}, 1};
  for (const MonitorRow& row : facts.boards.front().axes.front().session.monitor) {
    for (Curve* curve : {&setpoint, &chamber}) curve->x.push_back(row.t_s / 3600);
    setpoint.y.push_back(row.setpoint_c);
    chamber.y.push_back(row.chamber_c);
  }
  figure.curves = {setpoint, chamber};
  for (const BoardFacts& board : facts.boards) {
    if (board.axes.empty()) continue;
    const int colours_used = static_cast<int>(figure.curves.size());
    Curve curve{"board " + board.board.name,         Curve::Style::line, {}, {}, {},
                colours_used == 2 ? 0 : colours_used};
    for (const MonitorRow& row : board.axes.front().session.monitor) {
      curve.x.push_back(row.t_s / 3600);
      curve.y.push_back(row.board_c);
    }
    figure.curves.push_back(std::move(curve));
  }
  return {"temperatures", "Grey: accepted dwells.", std::move(figure)};
}

std::vector<NamedFigure> axis_figures(const CampaignFacts& facts, const BoardFacts& board,
                                      const AxisFacts& axis) {
  std::vector<NamedFigure> figures;
  add_dwell(facts, board, axis, figures);
  add_drift(board, axis, figures);
  add_allan(board, axis, figures);
  return figures;
}

}  // namespace gyrocal::report
