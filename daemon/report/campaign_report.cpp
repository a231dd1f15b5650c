#include "daemon/report/campaign_report.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "daemon/report/acceptance.h"
#include "daemon/report/gnuplot.h"
#include "daemon/report/page.h"

namespace gyrocal::report {
namespace {

using Rows = std::vector<std::vector<std::string>>;

std::string number(double value, const char* format = "{:.4f}") {
  return std::isnan(value) ? "-" : fmt::format(fmt::runtime(format), value);
}

void add_conditions(Page& page, const CampaignFacts& facts) {
  const CampaignRow& campaign = facts.campaign;
  const auto accepted = std::count_if(facts.dwells.begin(), facts.dwells.end(),
                                      [](const DwellRow& dwell) { return !dwell.reject_reason; });
  const std::string began =
      campaign.utc_start_ns == 0
          ? "unknown"
          : fmt::format("{:%Y-%m-%d %H:%M} UTC",
                        fmt::gmtime(static_cast<std::time_t>(campaign.utc_start_ns / 1000000000)));
  page.heading("Conditions");
  page.table({"what", "how"},
             {{"state", campaign.state},
              {"began", began},
              {"devices", campaign.simulated ? "simulated" : "real"},
              {"setpoints planned", fmt::format("{}", facts.config.plan.setpoints.size())},
              {"samples a dwell", fmt::format("{}", campaign.samples_per_setpoint)},
              {"sample rate", fmt::format("{} Hz", campaign.sample_rate_hz)},
              {"dwells accepted", fmt::format("{}", accepted)},
              {"dwells rejected", fmt::format("{}", facts.dwells.size() - std::size_t(accepted))}});
  Rows boards;
  for (const BoardFacts& board : facts.boards) {
    boards.push_back({board.board.name, board.board.mcu_id, board.board.firmware_version,
                      board.board.hardware_version, board.board.device});
  }
  page.table({"board", "MCU id", "firmware", "hardware", "link"}, boards);
}

void add_verdicts(Page& page, const CampaignFacts& facts) {
  Rows rows;
  for (const BoardFacts& board : facts.boards) {
    for (const AxisFacts& axis : board.axes) {
      const Acceptance acceptance = judge(axis, facts.config.acceptance);
      rows.push_back({board.board.name, std::string(1, letter(axis.axis)), to_text(acceptance.word),
                      acceptance.reason});
    }
  }
  page.heading("Verdict");
  page.table({"board", "axis", "verdict", "why"}, rows);
}

void add_comparison(Page& page, const AxisFacts& axis) {
  if (axis.models.empty()) {
    page.paragraph("No model is stored: the campaign has not been analysed.");
    return;
  }
  Rows rows;
  std::vector<std::string> sentences;
  for (const ModelFacts& model : axis.models) {
    const ModelInsert& row = model.row;
    rows.push_back({row.method, number(row.rmse_dps), number(row.mae_dps), number(row.max_dps),
                    number(row.loocv_rmse_dps), number(row.block_rmse_dps),
                    number(row.effective_parameters, "{:.1f}"), row.recommended ? "yes" : ""});
    if (row.recommended && !row.reason.empty()) sentences.push_back(row.reason);
    if (!row.warnings.empty()) sentences.push_back(row.method + ": " + row.warnings);
  }
  page.table({"method", "RMSE, dps", "MAE, dps", "largest, dps", "leave-one-out, dps",
              "leave-a-block-out, dps", "parameters", "recommended"},
             rows);
  page.list(sentences);
}

Result<void> add_figure(Page& page, const NamedFigure& named) {
  const auto svg = svg_of(named.figure);
  if (!svg) return tl::unexpected(svg.error());
  page.figure(*svg, named.caption);
  return {};
}

Result<void> add_axes(Page& page, const CampaignFacts& facts) {
  for (const BoardFacts& board : facts.boards) {
    for (const AxisFacts& axis : board.axes) {
      page.heading(fmt::format("Board {}, axis {}", board.board.name, letter(axis.axis)));
      add_comparison(page, axis);
      for (const NamedFigure& figure : axis_figures(facts, board, axis)) {
        if (auto drawn = add_figure(page, figure); !drawn) return drawn;
      }
    }
  }
  return {};
}

std::string board_name(const CampaignFacts& facts, BoardId id) {
  const auto found = std::find_if(facts.boards.begin(), facts.boards.end(),
                                  [id](const BoardFacts& board) { return board.id == id; });
  return found == facts.boards.end() ? "?" : found->board.name;
}

void add_troubles(Page& page, const CampaignFacts& facts) {
  Rows rejected;
  for (const DwellRow& dwell : facts.dwells) {
    if (!dwell.reject_reason) continue;
    rejected.push_back({board_name(facts, dwell.board), fmt::format("{}", dwell.ordinal + 1),
                        fmt::format("{}", dwell.attempt), *dwell.reject_reason});
  }
  page.heading("Rejected dwells");
  if (rejected.empty()) {
    page.paragraph("None.");
  } else {
    page.table({"board", "setpoint number", "attempt", "why"}, rejected);
  }
  Rows events;
  for (const EventInsert& event : facts.events) {
    if (event.severity == "info") continue;
    events.push_back(
        {fmt::format("{:.3f}", 1e-9 * double(event.t_ns) / 3600), event.severity, event.text});
  }
  if (events.empty()) return;
  page.heading("Warnings and errors");
  page.table({"time, h", "severity", "what happened"}, events);
}

void add_provenance(Page& page, const CampaignFacts& facts, const std::string& software_version) {
  if (!facts.gap_steps.empty()) {
    page.heading("Diagnoses");
    page.table({"diagnosis", "session", "axis", "rig model before", "after", "step", "added",
                "gap before", "gap after"},
               facts.gap_steps);
  }
  page.heading("Provenance");
  std::vector<std::string> lines{"campaign run by gyrocal " + facts.campaign.software_version,
                                 "this report by gyrocal " + software_version};
  if (facts.analysis) {
    lines.push_back("analysis by gyrocal " + facts.analysis->software_version + ": " +
                    facts.analysis->settings_json);
  }
  for (const BoardFacts& board : facts.boards) {
    if (board.axes.empty() || board.axes.front().models.empty()) continue;
    lines.push_back(fmt::format("SHA-256 over the raw samples used of board {}: {}",
                                board.board.name,
                                board.axes.front().models.front().row.dwells_sha256));
  }
  page.list(lines);
}

}  // namespace

Result<std::string> campaign_report(const CampaignFacts& facts,
                                    const std::string& software_version) {
  Page page("Campaign " + facts.campaign.name);
  add_conditions(page, facts);
  add_verdicts(page, facts);
  page.heading("Temperatures");
  if (auto drawn = add_figure(page, temperature_figure(facts)); !drawn) {
    return tl::unexpected(drawn.error());
  }
  if (auto drawn = add_axes(page, facts); !drawn) return tl::unexpected(drawn.error());
  add_troubles(page, facts);
  add_provenance(page, facts, software_version);
  return page.finish();
}

}  // namespace gyrocal::report
