#include "daemon/status/metrics.h"

#include <fmt/core.h>

#include <cmath>
#include <string_view>

#include "daemon/campaign/campaign.h"

namespace gyrocal::status {
namespace {

/// A label's value: backslash, quote and line feed are escaped.
std::string label_value(std::string_view text) {
  std::string safe;
  for (const char c : text) {
    if (c == '\\' || c == '"') safe += '\\';
    if (c == '\n') {
      safe += "\\n";
    } else {
      safe += c;
    }
  }
  return safe;
}

class Text {
 public:
  explicit Text(const std::string& campaign)
      : campaign_(fmt::format("campaign=\"{}\"", label_value(campaign))) {}

  void family(std::string_view name, std::string_view type, std::string_view help) {
    name_ = name;
    text_ += fmt::format("# HELP {0} {2}\n# TYPE {0} {1}\n", name, type, help);
  }
  void value(double value, const std::string& labels = {}) {
    if (!std::isfinite(value)) return;
    text_ += fmt::format("{}{{{}{}{}}} {}\n", name_, campaign_, labels.empty() ? "" : ",", labels,
                         value);
  }
  void gauge(std::string_view name, std::string_view help, double measured) {
    family(name, "gauge", help);
    value(measured);
  }
  [[nodiscard]] std::string take() { return std::move(text_); }

 private:
  std::string campaign_;
  std::string_view name_;
  std::string text_;
};

std::string label(const BoardView& board) {
  return fmt::format("board=\"{}\"", label_value(board.name));
}

template <class Value>
void each_board(Text& text, std::string_view name, std::string_view type, std::string_view help,
                const std::vector<BoardView>& boards, const Value& value_of) {
  text.family(name, type, help);
  for (const BoardView& board : boards) text.value(value_of(board), label(board));
}

void add_boards(Text& text, const std::vector<BoardView>& boards) {
  each_board(text, "gyrocal_board_present", "gauge", "1 while the board streams", boards,
             [](const BoardView& b) { return b.present ? 1.0 : 0.0; });
  each_board(text, "gyrocal_board_temperature_celsius", "gauge", "mean of the latest 5 s", boards,
             [](const BoardView& b) { return b.board_c; });
  each_board(text, "gyrocal_board_temperature_slope_kelvin_per_hour", "gauge",
             "least squares over the stability window", boards,
             [](const BoardView& b) { return b.slope_k_per_h.value_or(missing); });
  each_board(text, "gyrocal_board_temperature_slope_limit_kelvin_per_hour", "gauge",
             "at most this counts as stable", boards,
             [](const BoardView& b) { return b.slope_limit_k_per_h; });
  each_board(text, "gyrocal_board_frames_per_second", "gauge", "over the latest 5 s", boards,
             [](const BoardView& b) { return b.frames_per_s; });
  each_board(text, "gyrocal_board_frames_total", "counter", "received since the daemon began",
             boards, [](const BoardView& b) { return double(b.frames); });
  each_board(text, "gyrocal_board_frames_missing_total", "counter",
             "sent by the board and never received", boards,
             [](const BoardView& b) { return double(b.frames_missing); });
  each_board(text, "gyrocal_board_restarts_total", "counter", "resets of the board", boards,
             [](const BoardView& b) { return double(b.restarts); });
  text.family("gyrocal_board_rate_degrees_per_second", "gauge", "mean of the latest 5 s");
  for (const BoardView& board : boards) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      text.value(board.rate_dps[axis], fmt::format("{},axis=\"{}\"", label(board), "xyz"[axis]));
    }
  }
}

}  // namespace

std::string metrics_text(const View& view) {
  Text text(view.facts.campaign);
  text.family("gyrocal_build_info", "gauge", "always 1; the version is a label");
  text.value(1, fmt::format("version=\"{}\"", label_value(view.facts.software_version)));
  text.family("gyrocal_campaign_state", "gauge", "1 for the present state, 0 for every other");
  const std::string state = view.now ? view.now->state : "preflight";
  for (const std::string_view name : campaign::state_names()) {
    text.value(state == name ? 1 : 0, fmt::format("state=\"{}\"", name));
  }
  text.gauge("gyrocal_concern_level", "0 nothing is wrong, 1 a warning, 2 an error",
             view.concern.severity == "error"     ? 2
             : view.concern.severity == "warning" ? 1
                                                  : 0);
  text.gauge("gyrocal_report_age_seconds", "since the campaign's loop last reported",
             view.silent_s);
  text.gauge("gyrocal_setpoints", "of the campaign", double(view.facts.setpoints_c.size()));
  text.family("gyrocal_events_total", "counter", "event rows of the campaign");
  text.value(double(view.events_total));
  if (!view.now) return text.take();
  const runner::Snapshot& now = *view.now;
  text.gauge("gyrocal_campaign_time_seconds", "since the campaign's start", to_seconds(now.t));
  text.gauge("gyrocal_campaign_state_seconds", "that the present state has lasted",
             to_seconds(now.t - now.since));
  text.gauge("gyrocal_campaign_left_seconds", "to the end, if nothing is disturbed",
             to_seconds(now.left));
  text.gauge("gyrocal_campaign_left_max_seconds", "to the end, with a cycling chamber's waits",
             to_seconds(now.left_max));
  text.gauge("gyrocal_setpoints_done", "so far", double(now.setpoints_done));
  text.gauge("gyrocal_chamber_temperature_celsius", "of the air",
             now.air ? now.air->value : missing);
  text.gauge("gyrocal_chamber_setpoint_celsius", "as the chamber says",
             now.setpoint ? now.setpoint->value : missing);
  text.gauge("gyrocal_chamber_reading_age_seconds", "of the last believed reading",
             to_seconds(now.chamber_age));
  add_boards(text, boards_of(view.facts, now));
  return text.take();
}

}  // namespace gyrocal::status
