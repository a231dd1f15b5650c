#include "config/daemon_settings.h"

#include <filesystem>

#include "config/text_file.h"
#include "config/toml_section.h"

namespace gyrocal {
namespace {

constexpr NumberRange some_port{1, 65535};
constexpr NumberRange some_while_s{1, 7 * 86400.0, "s"};

void read_status(TomlSection table, StatusSettings& into) {
  into.on = table.flag("on", into.on);
  into.address = table.text("address", into.address);
  into.port = static_cast<int>(table.integer("port", into.port, some_port));
  table.refuse_unknown_keys();
}

/// A path that starts at the settings' folder.
std::optional<std::string> beside(TomlSection& table, const char* key, const std::string& file) {
  const std::string named = table.text(key, "");
  if (named.empty()) return std::nullopt;
  return (std::filesystem::path(file).parent_path() / named).lexically_normal().string();
}

void read_notify(TomlSection table, const std::string& file, NotifySettings& into) {
  into.hook = beside(table, "hook", file);
  into.outage_s = table.number("outage_s", into.outage_s, some_while_s);
  into.behind_s = table.number("behind_s", into.behind_s, some_while_s);
  into.hook_timeout_s = table.number("hook_timeout_s", into.hook_timeout_s, {0.1, 600, "s"});
  into.hook_attempts =
      static_cast<int>(table.integer("hook_attempts", into.hook_attempts, {1, 20}));
  into.messages_per_hour_max = static_cast<int>(
      table.integer("messages_per_hour_max", into.messages_per_hour_max, {1, 3600}));
  into.heartbeat = beside(table, "heartbeat", file);
  into.heartbeat_interval_s =
      table.number("heartbeat_interval_s", into.heartbeat_interval_s, some_while_s);
  table.refuse_unknown_keys();
}

/// Who we are to the broker, and who it is to us.
void read_mqtt_security(TomlSection& table, const std::string& file, MqttSettings& into) {
  const std::string user = table.text("user", "");
  if (!user.empty()) into.user = user;
  into.password_file = beside(table, "password_file", file);
  if (into.password_file && !into.user) {
    table.expected("password_file", Errc::bad_input, "a user beside it, whose password it holds");
  }
  into.tls = table.flag("tls", into.tls);
  into.ca_file = beside(table, "ca_file", file);
  if (into.ca_file && !into.tls) {
    table.expected("ca_file", Errc::bad_input, "tls = true beside it");
  }
}

MqttSettings read_mqtt(TomlSection table, const std::string& file) {
  MqttSettings mqtt;
  mqtt.host = table.required_text("host", "the broker's name or address");
  read_mqtt_security(table, file, mqtt);
  mqtt.port = static_cast<int>(table.integer("port", mqtt.tls ? 8883 : mqtt.port, some_port));
  mqtt.topic = table.text("topic", mqtt.topic);
  const bool usable = !mqtt.topic.empty() && mqtt.topic.find_first_of("+#") == std::string::npos;
  if (!usable) table.expected("topic", Errc::bad_input, "a topic to publish below, without + or #");
  mqtt.interval_s = table.number("interval_s", mqtt.interval_s, some_while_s);
  table.refuse_unknown_keys();
  return mqtt;
}

}  // namespace

Result<DaemonSettings> parse_daemon_settings(const std::string& text, const std::string& path) {
  auto file = TomlFile::parse(text, path);
  if (!file) return tl::unexpected(file.error());
  auto root = file->root();
  DaemonSettings settings;
  read_status(root.section("status"), settings.status);
  read_notify(root.section("notify"), path, settings.notify);
  if (root.has("mqtt")) settings.mqtt = read_mqtt(root.section("mqtt"), path);
  root.refuse_unknown_keys();
  if (const auto problems = file->problems()) return tl::unexpected(*problems);
  return settings;
}

Result<DaemonSettings> read_daemon_settings(const std::string& path) {
  const auto text = read_text_file(path);
  if (!text) return tl::unexpected(text.error());
  return parse_daemon_settings(*text, path);
}

}  // namespace gyrocal
