#pragma once

#include <sys/eventfd.h>

#include <catch2/catch.hpp>
#include <string>
#include <thread>

#include "drivers/clocks.h"
#include "drivers/simulated/rig_server.h"
#include "tests/drivers/simulated/profiles.h"
#include "tests/drivers/simulated/scratch_folder.h"

namespace gyrocal {

/// A rig on real endpoints in a thread of its own, for clients that wait.
class RunningRig {
 public:
  explicit RunningRig(std::size_t boards = 0, double time_scale = 1.0)
      : clock_(time_scale),
        rig_({}, 1, boards, yinhe_profile(), 1, 1 << 20),
        stop_(::eventfd(0, EFD_CLOEXEC)),
        server_(RigServer::open(rig_, clock_, endpoints(boards), time_scale)) {
    REQUIRE(server_.has_value());
    thread_ = std::thread([this] { ended_well_ = server_->run(stop_.get()).has_value(); });
  }
  ~RunningRig() { end(); }
  RunningRig(const RunningRig&) = delete;
  RunningRig& operator=(const RunningRig&) = delete;

  [[nodiscard]] int port() const { return server_->port(); }
  [[nodiscard]] std::string link(std::size_t index) const {
    return folder_ / ("board" + std::to_string(index));
  }
  bool end() {
    if (thread_.joinable()) {
      ::eventfd_write(stop_.get(), 1);
      thread_.join();
    }
    return ended_well_;
  }

 private:
  RigEndpoints endpoints(std::size_t boards) const {
    RigEndpoints all;
    for (std::size_t index = 0; index < boards; ++index) all.links.push_back(link(index));
    return all;
  }

  ScratchFolder folder_;
  ScaledClock clock_;
  SimulatedRig rig_;
  UniqueFd stop_;
  Result<RigServer> server_;
  bool ended_well_ = false;
  std::thread thread_;
};

}  // namespace gyrocal
