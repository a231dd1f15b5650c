#include "daemon/status/numbers.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "daemon/campaign/campaign.h"
#include "daemon/report/page.h"
#include "daemon/runner/progress.h"
#include "daemon/status/status_json.h"

namespace gyrocal::status {
namespace {

using report::escaped;
using runner::clock_text;

constexpr char unknown[] = "&ndash;";

std::string number(double value, int decimals, const char* unit) {
  if (!std::isfinite(value)) return unknown;
  return fmt::format("{:.{}f}&nbsp;{}", value, decimals, unit);
}

std::string number(const std::optional<Celsius>& value) {
  return value ? number(value->value, 1, "°C") : unknown;
}

/// "18:42 UTC", and its day if that is not the view's own.
std::string moment(const View& view, std::int64_t utc_ns) {
  const std::string iso = utc_text(utc_ns);
  const bool today = iso.substr(0, 10) == utc_text(view.utc_ns).substr(0, 10);
  return fmt::format("<time datetime=\"{0}\">{1}{2}&nbsp;UTC</time>", iso,
                     today ? "" : iso.substr(0, 10) + "&nbsp;", iso.substr(11, 5));
}

std::string concern_section(const Concern& concern) {
  const char* word = concern.severity == "error"     ? "Needs you"
                     : concern.severity == "warning" ? "Take note"
                                                     : "All well";
  const std::string advice =
      concern.advice.empty() ? ""
                             : fmt::format("<p class=\"advice\">{}</p>", escaped(concern.advice));
  return fmt::format(
      "<section id=\"concern\" class=\"concern {}\" role=\"status\"><strong>{}</strong>"
      "<div><p>{}</p>{}</div></section>\n",
      concern.severity, word, escaped(concern.sentence), advice);
}

std::string tile(const char* label, const std::string& value, const std::string& note) {
  return fmt::format("<div class=\"tile\"><dt>{}</dt><dd>{}</dd><dd class=\"note\">{}</dd></div>",
                     label, value, note);
}

std::string setpoint_tile(const runner::Snapshot& now) {
  const auto at = std::min(now.setpoints_done + 1, now.setpoints);
  const std::string share = now.dwell_share
                                ? fmt::format("dwell {:.0f}&nbsp;% logged", 100 * *now.dwell_share)
                                : fmt::format("{} done", now.setpoints_done);
  return tile("Setpoint", fmt::format("{} <small>of {}</small>", at, now.setpoints), share);
}

std::string eta_tile(const View& view) {
  const runner::Snapshot& now = *view.now;
  if (campaign::has_ended(now.state)) {
    return tile("Campaign time", clock_text(now.t), "ended");
  }
  const std::string note = fmt::format(
      "ends {}{}", moment(view, utc_of(view, now.t + now.left)),
      now.left_max > now.left
          ? fmt::format(", at the latest {}", moment(view, utc_of(view, now.t + now.left_max)))
          : "");
  return tile("Time left", clock_text(now.left), note);
}

double progress_of(const runner::Snapshot& now) {
  if (now.setpoints == 0) return 0;
  return (double(now.setpoints_done) + now.dwell_share.value_or(0)) / double(now.setpoints);
}

std::string progress_section(const View& view) {
  if (!view.now) {
    return fmt::format("<section id=\"progress\"><dl class=\"tiles\">{}</dl></section>\n",
                       tile("State", "preflight",
                            fmt::format("{} setpoints planned", view.facts.setpoints_c.size())));
  }
  const runner::Snapshot& now = *view.now;
  const std::string since = fmt::format("for {}, since {}", clock_text(now.t - now.since),
                                        moment(view, utc_of(view, now.since)));
  const double age_s = to_seconds(now.chamber_age);
  const std::string age = age_s < 120 ? fmt::format("read {:.0f}&nbsp;s ago", age_s)
                                      : fmt::format("read {} ago", clock_text(now.chamber_age));
  const bool stale = chamber_is_stale(view.facts, now);
  const std::string chamber_note = stale ? fmt::format("last {}, {}", number(now.air), age)
                                         : fmt::format("set {}, {}", number(now.setpoint), age);
  return fmt::format(
      "<section id=\"progress\"><p class=\"where\">{}</p>"
      "<progress max=\"1\" value=\"{:.4f}\">{:.0f} %</progress>"
      "<dl class=\"tiles\">{}{}{}{}</dl></section>\n",
      escaped(now.text), progress_of(now), 100 * progress_of(now), tile("State", now.state, since),
      setpoint_tile(now), tile("Chamber", stale ? unknown : number(now.air), chamber_note),
      eta_tile(view));
}

/// The label is for narrow screens, where a row becomes a list.
std::string cell(const std::string& label, const std::string& value) {
  return fmt::format("<td class=\"n\" data-label=\"{}\">{}</td>", label, value);
}

std::string slope_cell(const BoardView& board) {
  if (!board.slope_k_per_h) return cell("Slope K/h", unknown);
  const bool steady = std::abs(*board.slope_k_per_h) <= board.slope_limit_k_per_h;
  return fmt::format(
      "<td class=\"n {}\" data-label=\"Slope K/h\">{:+.2f} <small>of ±{:.1f}</small></td>",
      steady ? "steady" : "moving", *board.slope_k_per_h, board.slope_limit_k_per_h);
}

std::string board_row(const BoardView& board) {
  const char* state = board.present ? "streams" : board.given_up ? "given up" : "away";
  std::string row =
      fmt::format("<tr><th scope=\"row\">{}</th><td class=\"{}\" data-label=\"Link\">{}</td>",
                  escaped(board.name), board.present ? "steady" : "moving", state);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double rate = board.rate_dps[axis];
    row += cell(fmt::format("{} °/s", "XYZ"[axis]),
                std::isfinite(rate) ? fmt::format("{:+.3f}", rate) : unknown);
  }
  row += cell("Temperature", number(board.board_c, 2, "°C")) + slope_cell(board);
  row += cell("Frames", number(board.frames_per_s, 1, "/s"));
  row += cell("Lost", fmt::format("{} <small>{:.3f}&nbsp;%</small>", board.frames_missing,
                                  100 * board.lost_share));
  return row + "</tr>\n";
}

std::string boards_section(const View& view) {
  std::string rows;
  if (view.now) {
    for (const BoardView& board : boards_of(view.facts, *view.now)) rows += board_row(board);
  }
  return fmt::format(
      "<section id=\"boards\"><h2>Boards</h2><div class=\"wide\"><table><thead><tr><th>Board</th>"
      "<th>Link</th><th class=\"n\">X&nbsp;°/s</th><th class=\"n\">Y&nbsp;°/s</th>"
      "<th class=\"n\">Z&nbsp;°/s</th><th class=\"n\">Temperature</th>"
      "<th class=\"n\">Slope&nbsp;K/h</th><th class=\"n\">Frames</th><th class=\"n\">Lost</th>"
      "</tr></thead><tbody>\n{}</tbody></table></div></section>\n",
      rows);
}

std::string events_section(const View& view) {
  constexpr std::size_t listed = 60;
  std::string rows;
  for (std::size_t i = 0; i < std::min(listed, view.events.size()); ++i) {
    const EventInsert& event = view.events[view.events.size() - 1 - i];
    rows += fmt::format("<tr class=\"{}\"><td class=\"n\">{}</td><td>{}</td><td>{}</td></tr>\n",
                        event.severity, clock_text(Duration{event.t_ns}), escaped(event.kind),
                        escaped(event.text));
  }
  return fmt::format(
      "<section id=\"events\"><h2>Events</h2><div class=\"wide scroll\" tabindex=\"0\"><table>"
      "<thead><tr><th class=\"n\">Time</th><th>What</th><th>Text</th></tr></thead><tbody>\n{}"
      "</tbody></table></div><p class=\"note\">{} so far, the newest first; <a "
      "href=\"/api/events\">as JSON</a></p></section>\n",
      rows, view.events_total);
}

}  // namespace

std::string numbers_html(const View& view) {
  return concern_section(view.concern) + progress_section(view) + boards_section(view) +
         events_section(view);
}

std::string page_html(const View& view) {
  const std::string name = escaped(view.facts.campaign);
  const std::string simulated =
      view.facts.simulated
          ? fmt::format("<span class=\"badge\">simulated, {:g} times as fast</span>",
                        view.facts.time_scale)
          : "";
  return fmt::format(
      R"(<!doctype html>
<html lang="en">
<head><meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>{0} · gyrocal</title>
<link rel="stylesheet" href="/dygraph.css"><link rel="stylesheet" href="/page.css">
<link rel="icon" href="data:,">
<script src="/dygraph.js" defer></script><script src="/page.js" defer></script></head>
<body>
<header><h1>{0}</h1>{1}<span id="link" class="badge">as of {2}</span></header>
<main>
<div id="numbers">
{3}</div>
<div id="plots" hidden>
<h2>Temperature <small>°C</small><span class="legend" id="legend-temperature"></span></h2><div class="plot" id="plot-temperature"></div>
<h2>Z rate <small>°/s</small><span class="legend" id="legend-rate"></span></h2><div class="plot" id="plot-rate"></div>
<h2>Board temperature slope <small>K/h</small><span class="legend" id="legend-slope"></span></h2><div class="plot" id="plot-slope"></div>
<p class="note">Hours since the campaign's start. Drag to zoom, double-click to see all.</p>
</div>
<noscript><p class="note">Plots and live numbers need JavaScript; load the page again for newer
numbers.</p></noscript>
</main>
<footer>gyrocal {4} · {5} · <a href="/api/status">status</a> <a href="/metrics">metrics</a></footer>
</body>
</html>
)",
      name, simulated, moment(view, view.utc_ns), numbers_html(view),
      escaped(view.facts.software_version), escaped(view.facts.database));
}

}  // namespace gyrocal::status
