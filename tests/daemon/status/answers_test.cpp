// What the page, the API and the metrics say of one view.
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>

#include "daemon/status/metrics.h"
#include "daemon/status/numbers.h"
#include "daemon/status/server_sent_events.h"
#include "daemon/status/status_json.h"
#include "tests/daemon/status/sample_view.h"

namespace gyrocal::status {
namespace {

bool holds(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace

SCENARIO("/api/status says where the campaign stands, in units") {
  const auto json = nlohmann::json::parse(status_json(sample_view()));
  CHECK(json["format"] == "gyrocal-status/1");
  CHECK(json["state"] == "soaking");
  CHECK(json["setpoints_done"] == 1);
  CHECK(json["since_s"] == 100);
  CHECK(json["since_utc"] == "2025-11-13T02:13:10Z");  // 100 s of campaign time are 10 s of ours
  CHECK(json["eta"]["left_s"] == 3600);
  CHECK(json["eta"]["end_utc"] == "2025-11-13T02:19:20Z");
  CHECK(json["eta"]["end_utc_max"] == "2025-11-13T02:21:20Z");
  CHECK(json["chamber"]["temperature_c"] == 20.5);
  CHECK(json["chamber"]["setpoint_c"] == 20);
  REQUIRE(json["boards"].size() == 2);
  const auto& left = json["boards"][0];
  CHECK(left["rate_dps"] == nlohmann::json{1.0, 2.0, -1.0});
  CHECK(left["frames_per_s"] == 50);
  CHECK(left["slope_k_per_h"] == -1.5);
  CHECK(left["slope_limit_k_per_h"] == 2);
  CHECK(left["frames_lost_share"] == 0.001);
  CHECK(left["temperature_c"].is_null());  // no frame carried it
}

SCENARIO("before the campaign begins there is a status already") {
  LiveStatus live(sample_facts());
  const View view = live.at(sample_utc_ns, 0);
  const auto json = nlohmann::json::parse(status_json(view));
  CHECK(json["state"] == "preflight");
  CHECK(json["setpoints"] == 3);
  CHECK(holds(page_html(view), "preflight"));
  CHECK(holds(metrics_text(view), "state=\"preflight\"} 1\n"));
}

SCENARIO("events come oldest first, with bytes that are no text replaced") {
  const std::vector<EventInsert> events{{1'000'000'000, sample_utc_ns, "info", "first", "a"},
                                        {2'000'000'000, sample_utc_ns, "error", "bad", "b\xff"}};
  const auto json = nlohmann::json::parse(events_json(sample_view(sample_snapshot(), events)));
  CHECK(json["total"] == 2);
  CHECK(json["events"][0]["kind"] == "first");
  CHECK(json["events"][0]["t_s"] == 1);
  CHECK(json["events"][1]["text"] == "b\uFFFD");
}

SCENARIO("of ten thousand events the latest five hundred are kept, and all are counted") {
  LiveStatus live(sample_facts());
  for (int i = 0; i < 10000; ++i) live.report(EventInsert{i, 0, "info", std::to_string(i), ""});
  const View& view = live.at(0, 0);
  CHECK(view.events_total == 10000);
  REQUIRE(view.events.size() == 500);
  CHECK(view.events.front().kind == "9500");
}

SCENARIO("metrics carry their units and parse line by line") {
  const std::string text = metrics_text(sample_view());
  CHECK(holds(text, "gyrocal_chamber_temperature_celsius{campaign=\"weekend\"} 20.5\n"));
  CHECK(holds(text, "gyrocal_campaign_state{campaign=\"weekend\",state=\"soaking\"} 1\n"));
  CHECK(holds(text, "gyrocal_campaign_state{campaign=\"weekend\",state=\"safe\"} 0\n"));
  CHECK(
      holds(text, "gyrocal_board_frames_missing_total{campaign=\"weekend\",board=\"left\"} 10\n"));
  CHECK(holds(text, "{campaign=\"weekend\",board=\"right\",axis=\"y\"} 2\n"));
  CHECK_FALSE(holds(text, "nan"));
  const std::regex sample(R"re([a-z_]+\{([a-z]+="([^"\\]|\\.)*",?)*\} [-+0-9.e]+)re");
  const std::regex comment("# (HELP|TYPE) [a-z_]+ .+");
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    INFO(line);
    CHECK(std::regex_match(line, line.front() == '#' ? comment : sample));
  }
}

SCENARIO("a name that is a quotation stays one label") {
  auto facts = sample_facts();
  facts.campaign = "a\"b\\c\nd";
  LiveStatus live(facts);
  CHECK(holds(metrics_text(live.at(0, 0)), R"(campaign="a\"b\\c\nd")"));
}

SCENARIO("the page shows the numbers without a script") {
  const std::vector<EventInsert> events{{0, 0, "warning", "door", "<script>alert(1)</script>"}};
  const std::string page = page_html(sample_view(sample_snapshot(), events));
  CHECK(holds(page, "soaking at 20.0 degC (point 2 of 3)"));
  CHECK(holds(page, "20.5&nbsp;°C"));
  CHECK(holds(page, "1:00:00"));  // time left
  CHECK(holds(page, "-1.50 <small>of ±2.0</small>"));
  CHECK(holds(page, "&lt;script&gt;alert(1)"));
  CHECK_FALSE(holds(page, "<script>alert"));
  CHECK_FALSE(std::regex_search(page, std::regex("(src|href)=\"(https?:)?//")));  // nothing fetched
}

SCENARIO("what the plots show has one value a column and point") {
  const auto json = nlohmann::json::parse(history_json(sample_view()));
  REQUIRE(json["t_s"].size() == 1);
  CHECK(json["t_s"][0].get<double>() == Approx(1000));
  CHECK(json["chamber_c"] == nlohmann::json{20.5});
  CHECK(json["boards"][1]["rate_z_dps"] == nlohmann::json{-1.0});
  CHECK(json["boards"][1]["temperature_c"] == nlohmann::json{nullptr});
}

SCENARIO("what is away or too old is shown as unknown, not as it was last") {
  auto now = sample_snapshot();
  now.chamber_age = seconds(16);
  now.each_board[0].present = false;
  const View view = sample_view(now);
  CHECK(nlohmann::json::parse(status_json(view))["chamber"]["stale"] == true);
  const auto history = nlohmann::json::parse(history_json(view));
  CHECK(history["chamber_c"] == nlohmann::json{nullptr});
  CHECK(history["boards"][0]["rate_z_dps"] == nlohmann::json{nullptr});
  CHECK(history["boards"][1]["rate_z_dps"] == nlohmann::json{-1.0});
  CHECK(holds(numbers_html(view), "last 20.5&nbsp;°C, read 16&nbsp;s ago"));
}

SCENARIO("a server-sent event keeps its lines together") {
  CHECK(server_sent_event("numbers", "one\r\ntwo") == "event: numbers\ndata: one\ndata: two\n\n");
}

}  // namespace gyrocal::status
