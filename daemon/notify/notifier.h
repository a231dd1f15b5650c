#pragma once

#include <memory>

#include "config/daemon_settings.h"
#include "daemon/status/facts.h"
#include "daemon/status/mailbox.h"

namespace gyrocal::notify {

/// Tells people who are not there, from its own thread for as long as it lives: runs hooks, repeats
/// the heartbeat, feeds a broker. What fails is written to stderr and changes nothing else. When it
/// goes, the messages still on their way get one more try, for twenty seconds at most.
class Notifier {
 public:
  /// @return nothing if the settings ask for nothing.
  [[nodiscard]] static std::unique_ptr<Notifier> start(const DaemonSettings& settings,
                                                       status::Facts facts);
  virtual ~Notifier() = default;
  /// What the loop has to say is put there; it never waits for anything here.
  [[nodiscard]] virtual status::Mailbox& mailbox() = 0;
};

}  // namespace gyrocal::notify
