#include "config/daemon_settings.h"

#include <catch2/catch.hpp>

namespace gyrocal {
namespace {

std::string problem(const std::string& text) {
  const auto settings = parse_daemon_settings(text, "/etc/gyrocal/gyrocald.toml");
  return settings ? "" : settings.error().what;
}

}  // namespace

SCENARIO("an empty file serves the page on this machine and tells nobody") {
  const auto settings = parse_daemon_settings("", "gyrocald.toml");
  REQUIRE(settings);
  CHECK(settings->status.on);
  CHECK(settings->status.address == "127.0.0.1");
  CHECK(settings->status.port == 8470);
  CHECK_FALSE(settings->notify.hook);
  CHECK_FALSE(settings->mqtt);
}

SCENARIO("hooks are looked for beside the file") {
  const auto settings = parse_daemon_settings(
      "[notify]\nhook = \"notify/mail\"\nheartbeat = \"/usr/bin/true\"\n[mqtt]\nhost = \"b\"\n",
      "/etc/gyrocal/gyrocald.toml");
  REQUIRE(settings);
  CHECK(settings->notify.hook == "/etc/gyrocal/notify/mail");
  CHECK(settings->notify.heartbeat == "/usr/bin/true");
  CHECK(settings->mqtt->port == 1883);
}

SCENARIO("what cannot be meant is refused with its line") {
  CHECK(problem("[status]\nport = 70000\n").find("gyrocald.toml:2") != std::string::npos);
  CHECK(problem("[status]\nprot = 80\n").find("port") != std::string::npos);
  CHECK(problem("[statsu]\n").find("status") != std::string::npos);
  CHECK(problem("[mqtt]\n").find("host") != std::string::npos);
  CHECK(problem("[mqtt]\nhost = \"b\"\ntopic = \"a/#\"\n").find("topic") != std::string::npos);
  CHECK(problem("[notify]\nhook_timeout_s = nan\n").find("hook_timeout_s") != std::string::npos);
}

SCENARIO("the example says the defaults it names") {
  const auto example =
      read_daemon_settings(std::string(GYROCAL_SOURCE_DIR) + "/config/gyrocald.toml");
  if (!example) FAIL(to_text(example.error()));
  const DaemonSettings defaults;
  CHECK(example->status.port == defaults.status.port);
  CHECK(example->notify.outage_s == defaults.notify.outage_s);
  CHECK(example->notify.behind_s == defaults.notify.behind_s);
  CHECK(example->notify.hook_timeout_s == defaults.notify.hook_timeout_s);
  CHECK(example->notify.hook_attempts == defaults.notify.hook_attempts);
  CHECK(example->notify.messages_per_hour_max == defaults.notify.messages_per_hour_max);
  CHECK(example->notify.heartbeat_interval_s == defaults.notify.heartbeat_interval_s);
}

}  // namespace gyrocal
