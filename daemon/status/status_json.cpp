#include "daemon/status/status_json.h"

#include <fmt/chrono.h>
#include <fmt/core.h>

#include <cmath>

#include "daemon/status/json_text.h"

namespace gyrocal::status {
namespace {

using Json = nlohmann::ordered_json;

Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

template <class T>
Json number(const std::optional<T>& value) {
  if (!value) return nullptr;
  if constexpr (std::is_same_v<T, double>) {
    return number(*value);
  } else {
    return number(value->value);
  }
}

Json json_of(const BoardView& board) {
  return {{"name", board.name},
          {"present", board.present},
          {"given_up", board.given_up},
          {"trouble", board.trouble},
          {"temperature_c", number(board.board_c)},
          {"rate_dps",
           {number(board.rate_dps[0]), number(board.rate_dps[1]), number(board.rate_dps[2])}},
          {"slope_k_per_h", number(board.slope_k_per_h)},
          {"slope_limit_k_per_h", number(board.slope_limit_k_per_h)},
          {"frames_per_s", number(board.frames_per_s)},
          {"frames", board.frames},
          {"frames_missing", board.frames_missing},
          {"frames_lost_share", number(board.lost_share)},
          {"restarts", board.restarts}};
}

void add_progress(const View& view, Json& json) {
  const runner::Snapshot& now = *view.now;
  json["state"] = now.state;
  json["text"] = now.text;
  json["t_s"] = to_seconds(now.t);
  json["since_s"] = to_seconds(now.t - now.since);
  json["since_utc"] = utc_text(utc_of(view, now.since));
  json["setpoints"] = now.setpoints;
  json["setpoints_done"] = now.setpoints_done;
  json["dwell_share"] = number(now.dwell_share);
  json["eta"] = {{"left_s", to_seconds(now.left)},
                 {"left_s_max", to_seconds(now.left_max)},
                 {"end_utc", utc_text(utc_of(view, now.t + now.left))},
                 {"end_utc_max", utc_text(utc_of(view, now.t + now.left_max))}};
  json["chamber"] = {{"temperature_c", number(now.air)},
                     {"setpoint_c", number(now.setpoint)},
                     {"reading_age_s", to_seconds(now.chamber_age)},
                     {"stale", chamber_is_stale(view.facts, now)}};
  json["boards"] = Json::array();
  for (const BoardView& board : boards_of(view.facts, now))
    json["boards"].push_back(json_of(board));
}

}  // namespace

std::string utc_text(std::int64_t utc_ns) {
  const std::chrono::sys_seconds whole{std::chrono::seconds{utc_ns / 1'000'000'000}};
  return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}",
                     fmt::gmtime(std::chrono::system_clock::to_time_t(whole)));
}

std::string status_json(const View& view) {
  Json json{{"format", "gyrocal-status/1"},
            {"campaign", view.facts.campaign},
            {"simulated", view.facts.simulated},
            {"time_scale", view.facts.time_scale},
            {"database", view.facts.database},
            {"software_version", view.facts.software_version},
            {"utc", utc_text(view.utc_ns)},
            {"silent_s", view.silent_s},
            {"concern",
             {{"severity", view.concern.severity},
              {"sentence", view.concern.sentence},
              {"advice", view.concern.advice}}},
            {"events_total", view.events_total}};
  if (view.now) {
    add_progress(view, json);
  } else {
    json["state"] = "preflight";
    json["setpoints"] = view.facts.setpoints_c.size();
    json["setpoints_done"] = nullptr;
  }
  return json_text(json);
}

std::string events_json(const View& view) {
  Json json{{"format", "gyrocal-events/1"}, {"total", view.events_total}};
  json["events"] = Json::array();
  for (const EventInsert& event : view.events) {
    json["events"].push_back({{"t_s", double(event.t_ns) * 1e-9},
                              {"utc", utc_text(event.utc_ns)},
                              {"severity", event.severity},
                              {"kind", event.kind},
                              {"text", event.text}});
  }
  return json_text(json);
}

std::string history_json(const View& view) {
  Json t = Json::array();
  Json chamber = Json::array();
  Json setpoint = Json::array();
  for (const Point& point : view.history) {
    t.push_back(point.t_s);
    chamber.push_back(number(point.chamber_c));
    setpoint.push_back(number(point.setpoint_c));
  }
  Json json{{"format", "gyrocal-history/1"},
            {"slope_limit_k_per_h", view.facts.slope_limit_k_per_h},
            {"t_s", t},
            {"chamber_c", chamber},
            {"setpoint_c", setpoint}};
  json["boards"] = Json::array();
  for (std::size_t i = 0; i < view.facts.boards.size(); ++i) {
    Json board{{"name", view.facts.boards[i].name}};
    const auto column = [&](const char* name, double Point::Board::*member) {
      Json values = Json::array();
      for (const Point& point : view.history) {
        values.push_back(i < point.boards.size() ? number(point.boards[i].*member) : Json(nullptr));
      }
      board[name] = std::move(values);
    };
    column("temperature_c", &Point::Board::board_c);
    column("rate_z_dps", &Point::Board::rate_z_dps);
    column("slope_k_per_h", &Point::Board::slope_k_per_h);
    json["boards"].push_back(std::move(board));
  }
  return json_text(json);
}

}  // namespace gyrocal::status
