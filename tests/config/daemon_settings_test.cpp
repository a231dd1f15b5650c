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

SCENARIO("a broker's password stands in a file of its own, beside the settings") {
  const auto settings = parse_daemon_settings(
      "[mqtt]\nhost = \"b\"\nuser = \"lab\"\npassword_file = \"mqtt.password\"\ntls = true\n"
      "ca_file = \"/etc/ssl/lab.pem\"\n",
      "/etc/gyrocal/gyrocald.toml");
  REQUIRE(settings);
  CHECK(settings->mqtt->user == "lab");
  CHECK(settings->mqtt->password_file == "/etc/gyrocal/mqtt.password");
  CHECK(settings->mqtt->tls);
  CHECK(settings->mqtt->ca_file == "/etc/ssl/lab.pem");
  CHECK(settings->mqtt->port == 8883);
  CHECK(parse_daemon_settings("[mqtt]\nhost = \"b\"\ntls = true\nport = 1\n", "f")->mqtt->port ==
        1);
  for (const std::string key : {"password", "pasword", "passwd"}) {
    const auto told = problem("[mqtt]\nhost = \"b\"\n" + key + " = \"secret\"\n");
    CHECK(told.find("password_file") != std::string::npos);
    CHECK(told.find("secret") == std::string::npos);
  }
  CHECK(problem("[mqtt]\nhost = \"b\"\npassword_file = \"p\"\n").find("a user beside it") !=
        std::string::npos);
  CHECK(problem("[mqtt]\nhost = \"b\"\nca_file = \"c\"\n").find("tls = true") != std::string::npos);
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
