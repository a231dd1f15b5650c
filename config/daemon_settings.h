#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "compensation/values/error.h"

namespace gyrocal {

/// The page gyrocald serves. It can be read, nothing can be changed through it.
struct StatusSettings {
  bool on = true;
  std::string address = "127.0.0.1";  ///< a number, not a name; who may look is the site's decision
  int port = 8470;
};

/// Whom gyrocald tells. A hook is a program that gets the facts as JSON on its standard input.
struct NotifySettings {
  std::optional<std::string> hook;
  double outage_s = 300;       ///< a device away for longer than this is worth a message
  double behind_s = 1800;      ///< as is an end later than promised by this
  double hook_timeout_s = 20;  ///< then it is killed
  int hook_attempts = 4;       ///< of a message that its hook fails to deliver
  int messages_per_hour_max = 12;
  std::optional<std::string> heartbeat;  ///< run again and again while all is well
  double heartbeat_interval_s = 600;
};

/// A broker that is fed what the page shows.
struct MqttSettings {
  std::string host;
  int port = 1883;                           ///< 8883 with TLS, unless the file says otherwise
  std::optional<std::string> user;           ///< with it:
  std::optional<std::string> password_file;  ///< a path; its first line is read at each log-in
  bool tls = false;                          ///< encrypted; the broker's certificate is checked
  std::optional<std::string> ca_file;        ///< against this PEM file, else the system's CAs
  std::string topic = "gyrocal";             ///< topic/CAMPAIGN/status, .../event, .../online
  double interval_s = 10;
};

/// How gyrocald tells people, apart from campaign files: it may change while a campaign runs on.
struct DaemonSettings {
  StatusSettings status;
  NotifySettings notify;
  std::optional<MqttSettings> mqtt;
};

/// The settings' file name; it stands beside the campaign files.
inline constexpr char daemon_settings_name[] = "gyrocald.toml";

/// Reads and checks such a file; hooks named by relative paths start at its folder. Durations are
/// the machine's own time, whatever time_scale a simulated campaign has.
/// @return bad_input, out_of_range or storage; `what` names file, line, key and what was expected.
[[nodiscard]] Result<DaemonSettings> read_daemon_settings(const std::string& path);
[[nodiscard]] Result<DaemonSettings> parse_daemon_settings(const std::string& text,
                                                           const std::string& path);

}  // namespace gyrocal
