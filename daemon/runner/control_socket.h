#pragma once

#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "daemon/campaign/campaign.h"
#include "daemon/runner/campaign_runner.h"
#include "drivers/tty_lock.h"

namespace gyrocal::runner {

/// Where sockets of running campaigns stand: $RUNTIME_DIRECTORY of a systemd unit, else
/// $XDG_RUNTIME_DIR/gyrocal, else /run/gyrocal for root, /tmp/gyrocal-UID for others.
[[nodiscard]] std::string runtime_folder();
[[nodiscard]] std::string control_path(const std::string& campaign_name);
/// Where a person's command looks for them: the folder above, and that of systemd units.
[[nodiscard]] std::vector<std::string> folders_of_running_campaigns();

/// A running campaign's ear: one line in ("status", "pause", "resume", "skip", "abort"), one line
/// of JSON back. Who may write to the socket's file may command (owner and group). Served from the
/// campaign's own loop; nothing here waits.
class ControlSocket {
 public:
  /// Makes the folder and the socket; one left over from a dead process is replaced.
  /// @return busy if a living process answers there, storage if it cannot be made.
  [[nodiscard]] static Result<ControlSocket> open(const std::string& path);
  ControlSocket(ControlSocket&&) noexcept = default;
  ControlSocket& operator=(ControlSocket&&) noexcept = delete;
  ~ControlSocket();

  /// The next command an operator has sent, for the state machine.
  [[nodiscard]] std::optional<campaign::Event> next_command();
  /// Where the campaign stands now: answers who asked for that, and who commanded since.
  void serve(const Snapshot& now);

 private:
  struct Client {
    UniqueFd socket;
    std::string input{};
    bool awaits_outcome = false;  ///< of the command it sent
    bool done = false;
  };
  ControlSocket(UniqueFd listener, std::string path);
  void accept_clients();
  void read_line(Client& client);
  void obey(Client& client, const std::string& line);

  UniqueFd listener_;
  std::string path_;
  std::vector<Client> clients_;
  std::deque<campaign::Event> commands_;
  Snapshot before_;  ///< what the last turn ended with
};

/// {"state", "text", "t_s", "setpoints", ...}: what `gyrocal status --json` prints.
[[nodiscard]] std::string snapshot_json(const Snapshot& now);

/// One command to a running campaign. @return its line of JSON; link_lost if none runs there,
///   timeout if it does not answer within 10 s.
[[nodiscard]] Result<std::string> ask_campaign(const std::string& path, const std::string& command);

}  // namespace gyrocal::runner
