// In place of mosquitto_broker.cpp where libmosquitto was not found at build time.
#include <fmt/core.h>

#include "daemon/notify/broker.h"

namespace gyrocal::notify {

std::unique_ptr<Broker> Broker::connect(const MqttSettings& settings, const std::string&) {
  fmt::print(stderr,
             "gyrocald: warning: no feed to broker {}: built without libmosquitto (Debian: "
             "libmosquitto-dev)\n",
             settings.host);
  return nullptr;
}

}  // namespace gyrocal::notify
