#pragma once

#include <memory>
#include <string>

#include "config/daemon_settings.h"
#include "schema/store.h"

namespace gyrocal::notify {

/// A feed to an MQTT broker, below TOPIC/CAMPAIGN:
///   online  "1" retained; "0" when the daemon ends, or by the broker itself (last will) when it
///   dies status  as /api/status, retained        event  {"t_s","severity","kind","text"}
/// Connects, and connects again, in libmosquitto's own thread; nothing here waits. While the broker
/// is away what is published is dropped: the next status tells all that counts.
class Broker {
 public:
  /// @return nothing if this program was built without libmosquitto; that is told on stderr.
  [[nodiscard]] static std::unique_ptr<Broker> connect(const MqttSettings& settings,
                                                       const std::string& campaign);
  virtual ~Broker() = default;
  virtual void status(const std::string& json) = 0;
  virtual void event(const EventInsert& event) = 0;
};

}  // namespace gyrocal::notify
