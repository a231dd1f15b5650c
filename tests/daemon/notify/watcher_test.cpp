#include "daemon/notify/watcher.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "tests/daemon/status/sample_view.h"

namespace gyrocal::notify {
namespace {

using status::sample_snapshot;

/// A watcher of a campaign ten times as fast as the machine, and what it said last.
struct Watched {
  explicit Watched(double behind_s = 1800) : watcher(300, behind_s) {}
  std::vector<std::string> look(const runner::Snapshot& now, double machine_s) {
    live.report(now, machine_s);
    return kinds(machine_s);
  }
  std::vector<std::string> kinds(double machine_s) {
    said = watcher.look(live.at(status::sample_utc_ns, machine_s), machine_s);
    std::vector<std::string> names;
    for (const Notice& notice : said) names.push_back(notice.kind);
    return names;
  }
  status::LiveStatus live{status::sample_facts()};
  Watcher watcher;
  std::vector<Notice> said;
};

using Kinds = std::vector<std::string>;

}  // namespace

SCENARIO("a campaign that goes as it should sends no message") {
  Watched watched;
  for (int i = 0; i < 100; ++i) {
    auto now = sample_snapshot();
    now.t += seconds(10.0 * i);
    now.left -= seconds(10.0 * i);
    now.left_max -= seconds(10.0 * i);
    CHECK(watched.look(now, i).empty());
  }
}

SCENARIO("a trip is told once, with its reason and what to do") {
  Watched watched;
  auto now = sample_snapshot();
  now.state = "safe";
  now.why = "the air is beyond its limit";
  CHECK(watched.look(now, 1) == Kinds{"trip"});
  CHECK(watched.said[0].severity == "error");
  CHECK(watched.said[0].sentence == "The campaign has tripped: the air is beyond its limit.");
  CHECK(watched.said[0].advice.find("--resume") != std::string::npos);
  CHECK(watched.look(now, 2).empty());
}

SCENARIO("the end is told once") {
  Watched watched;
  auto now = sample_snapshot();
  now.state = "finished";
  CHECK(watched.look(now, 1) == Kinds{"ended"});
  CHECK(watched.look(now, 2).empty());
}

SCENARIO("an outage is told when it has lasted, and again when it is over") {
  Watched watched(1e9);
  auto away = sample_snapshot();
  away.each_board[0].present = false;
  away.each_board[0].trouble = "unplugged";
  CHECK(watched.look(away, 0).empty());
  CHECK(watched.look(away, 299).empty());
  CHECK(watched.look(away, 300) == Kinds{"outage"});
  CHECK(watched.said[0].sentence == "For 5 min: board left is away (unplugged).");
  CHECK(watched.look(away, 900).empty());
  CHECK(watched.look(sample_snapshot(), 1000) == Kinds{"outage_over"});
  CHECK(watched.look(away, 1100).empty());
  CHECK(watched.look(away, 1400) == Kinds{"outage"});
}

SCENARIO("a short outage is no message, and does not add to the next one") {
  Watched watched(1e9);
  auto away = sample_snapshot();
  away.state = "holding";
  away.why = "the chamber is away";
  for (double t = 0; t < 3000; t += 500) {
    CHECK(watched.look(away, t).empty());
    CHECK(watched.look(away, t + 200).empty());
    CHECK(watched.look(sample_snapshot(), t + 250).empty());
  }
}

SCENARIO("setpoints given up are told at the second, and again when they have doubled") {
  Watched watched(1e9);
  const EventInsert gone{0, 0, "error", "setpoint_failed",
                         "setpoint 10.0 degC given up after one try: the air goes up and down"};
  std::vector<std::size_t> told;
  for (std::size_t n = 1; n <= 9; ++n) {
    watched.live.report(gone);
    if (watched.look(sample_snapshot(), 0) == Kinds{"failing"}) told.push_back(n);
    CHECK(watched.look(sample_snapshot(), 0).empty());
  }
  CHECK(told == std::vector<std::size_t>{2, 4, 8});
  CHECK(watched.said.empty());
}

SCENARIO("falling behind the latest end once promised is told, and again only for another slip") {
  Watched watched;
  auto now = sample_snapshot();  // promises an end 480 s of ours from now, at the latest
  CHECK(watched.look(now, 0).empty());
  now.left = seconds(3600);
  CHECK(watched.look(now, 1900).empty());  // would end at 2260: 1780 later
  CHECK(watched.look(now, 1920) == Kinds{"behind"});
  CHECK(watched.said[0].sentence.find("0:30:00 later than it promised") != std::string::npos);
  CHECK(watched.look(now, 2000).empty());
  CHECK(watched.look(now, 4000) == Kinds{"behind"});
}

SCENARIO("a loop that stops reporting is told once, and may be again after it came back") {
  Watched watched;
  CHECK(watched.look(sample_snapshot(), 0).empty());
  CHECK(watched.kinds(60).empty());
  CHECK(watched.kinds(61) == Kinds{"silent"});
  CHECK(watched.kinds(100).empty());
  CHECK(watched.look(sample_snapshot(), 101).empty());
  CHECK(watched.kinds(162) == Kinds{"silent"});
}

SCENARIO("a hook gets the facts as JSON, and a subject of one line") {
  const Notice notice{"trip", "error", "It has\ntripped.", "Look after it."};
  const auto json = nlohmann::json::parse(notice_json(notice, status::sample_view(), "lab-pc", 3));
  CHECK(json["format"] == "gyrocal-notice/1");
  CHECK(json["kind"] == "trip");
  CHECK(json["host"] == "lab-pc");
  CHECK(json["withheld"] == 3);
  CHECK(json["status"]["setpoints_done"] == 1);
  CHECK(subject(notice, "weekend") == "weekend: trip: It has tripped.");
}

}  // namespace gyrocal::notify
