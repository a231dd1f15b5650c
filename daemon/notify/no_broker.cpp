// In place of mosquitto_broker.cpp where libmosquitto was not found at build time.
#include <spdlog/spdlog.h>

#include "daemon/notify/broker.h"

namespace gyrocal::notify {

std::unique_ptr<Broker> Broker::connect(const MqttSettings& settings, const std::string&) {
  spdlog::warn("no feed to broker {}: built without libmosquitto (Debian: libmosquitto-dev)",
               settings.host);
  return nullptr;
}

}  // namespace gyrocal::notify
