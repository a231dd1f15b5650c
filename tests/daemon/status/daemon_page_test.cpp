// gyrocald as it runs: its page, what becomes of it over a crash, and a port that is taken.
#include <fmt/core.h>
#include <signal.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <thread>

#include "tests/daemon/runner/daemon_process.h"
#include "tests/daemon/runner/served_rig.h"
#include "tests/daemon/status/http_client.h"

namespace gyrocal::status {
namespace {

using namespace std::chrono_literals;
using nlohmann::json;

/// Asks until `holds` is true of the answer; gives up after a minute.
template <class Predicate>
json wait_for(int port, const std::string& path, const Predicate& holds) {
  const auto until = std::chrono::steady_clock::now() + 60s;
  json answer;
  while (std::chrono::steady_clock::now() < until) {
    answer = json::parse(body_of(get(port, path)), nullptr, false);
    if (answer.is_object() && holds(answer)) return answer;
    std::this_thread::sleep_for(50ms);
  }
  FAIL("not within a minute: " << path << ", last " << answer.dump());
  return answer;
}

void write_settings(const runner::TemporaryFolder& folder, int port) {
  std::ofstream(folder / "gyrocald.toml") << "[status]\nport = " << port << "\n";
}

std::string text_of(const std::string& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

}  // namespace

SCENARIO("the page lives with the daemon, and after a crash shows what was before it") {
  const runner::TemporaryFolder folder;
  const runner::ServedRig rig(folder);
  const int port = free_port();
  const std::string campaign =
      folder.write("wired.toml", runner::campaign_text(folder, rig.port()));
  write_settings(folder, port);
  {
    const runner::Daemon daemon(campaign, folder / "page.db");
    const auto soaking = wait_for(port, "/api/status", [](const json& status) {
      return status["state"] == "soaking" && status["boards"][0]["frames_per_s"].is_number();
    });
    CHECK(soaking["setpoints"] == 3);
    CHECK(soaking["concern"]["severity"] == "info");
    CHECK(soaking["boards"].size() == 2);
    CHECK(get(port, "/metrics").find("state=\"soaking\"} 1\n") != std::string::npos);
    CHECK(get(port, "/").find("soaking at 20.0 degC (point 1 of 3)") != std::string::npos);
  }  // killed
  CHECK(get(port, "/").empty());
  const runner::Daemon again(campaign, folder / "page.db");
  const auto events = wait_for(port, "/api/events", [](const json& answer) {
    return answer["events"].size() > 2 && answer.dump().find("\"resumed\"") != std::string::npos;
  });
  CHECK(events["events"][0]["text"].get<std::string>().find("preflight -> ramping") == 0);
  const auto history = json::parse(body_of(get(port, "/api/history")));
  CHECK(history["t_s"][0] < 60);
}

SCENARIO("a port that is taken costs the page and not the campaign") {
  const runner::TemporaryFolder folder;
  const runner::ServedRig rig(folder);
  const int port = free_port();
  const UniqueFd taken(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0));
  const sockaddr_in address = local(port);
  REQUIRE(::bind(taken.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0);
  REQUIRE(::listen(taken.get(), 1) == 0);
  const std::string campaign =
      folder.write("wired.toml", runner::campaign_text(folder, rig.port()));
  write_settings(folder, port);
  const runner::Daemon daemon(campaign, folder / "page.db");
  const auto until = std::chrono::steady_clock::now() + 60s;
  while (text_of(folder / "page.db.log").find("-> soaking") == std::string::npos) {
    REQUIRE(std::chrono::steady_clock::now() < until);
    std::this_thread::sleep_for(50ms);
  }
  CHECK(text_of(folder / "page.db.log").find("warning: no status page") != std::string::npos);
}

}  // namespace gyrocal::status
