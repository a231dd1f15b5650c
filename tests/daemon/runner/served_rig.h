#pragma once

#include <fmt/core.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <thread>

#include "config/campaign.h"
#include "drivers/clocks.h"
#include "drivers/simulated/rig_server.h"
#include "tests/daemon/runner/temporary_folder.h"

namespace gyrocal::runner {

#ifdef __SANITIZE_THREAD__
inline constexpr double rig_scale = 50;  // a daemon ten times as slow must still keep up
#else
inline constexpr double rig_scale = 300;
#endif

inline ChamberProfile yinhe() {
  const auto profile =
      read_chamber_profile(std::string(GYROCAL_SOURCE_DIR) + "/config/chambers/yinhe.toml");
  if (!profile) FAIL(to_text(profile.error()));
  return *profile;
}

/// The rig on free endpoints, served until it goes.
class ServedRig {
 public:
  /// @param faults  of the rig, at its own time: seconds of campaign time since it is served.
  explicit ServedRig(const TemporaryFolder& folder, std::vector<RigFault> faults = {},
                     double scale = rig_scale)
      : clock_(scale), rig_(rig::RigModel{}, 5, 2, yinhe(), 1), stop_(::eventfd(0, EFD_CLOEXEC)) {
    rig_.set_faults(std::move(faults));
    RigEndpoints endpoints;
    endpoints.links = {folder / "board0", folder / "board1"};
    auto server = RigServer::open(rig_, clock_, endpoints, scale);
    REQUIRE(server);
    port_ = server->port();
    thread_ = std::thread(
        [this, served = std::move(*server)]() mutable { static_cast<void>(served.run(stop_)); });
  }
  ~ServedRig() {
    const std::uint64_t one = 1;
    static_cast<void>(!::write(stop_, &one, sizeof one));
    thread_.join();
    ::close(stop_);
  }
  ServedRig(const ServedRig&) = delete;
  ServedRig& operator=(const ServedRig&) = delete;
  [[nodiscard]] int port() const { return port_; }

 private:
  ScaledClock clock_;
  SimulatedRig rig_;
  int stop_;
  int port_ = 0;
  std::thread thread_;
};

/// Three setpoints, two boards, on the served rig.
inline std::string campaign_text(const TemporaryFolder& folder, int port) {
  return fmt::format(R"([campaign]
name = "wired-{0}"
simulated = true
time_scale = {1}
[plan]
setpoints_c = [20, 25, 30]
samples_per_setpoint = 200
ramp_k_per_min = 2
safe_setpoint_c = 25
[chamber]
profile = "yinhe"
host = "127.0.0.1"
port = {2}
[[board]]
name = "left"
device = "{3}"
[[board]]
name = "right"
device = "{4}"
[stability]
air_window_s = 120
board_window_s = 300
soak_s_min = 150
[limits]
chamber_stale_s = 3000
board_stale_s = 3000
)",
                     ::getpid(), rig_scale, port, folder / "board0", folder / "board1");
}

}  // namespace gyrocal::runner
