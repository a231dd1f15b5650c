#pragma once

#include <string>
#include <vector>

#include "compensation/values/error.h"
#include "drivers/clock.h"
#include "drivers/simulated/board_pty.h"
#include "drivers/simulated/modbus_tcp_server.h"
#include "drivers/simulated/simulated_rig.h"

namespace gyrocal {

/// Where a rig is to be found.
struct RigEndpoints {
  std::string host = "127.0.0.1";
  int port = 0;                    ///< 0: any free one
  std::vector<std::string> links;  ///< one a board; folders are made and, if made, removed again
};

/// A rig on real endpoints: its chamber a Modbus TCP server, its boards pseudo-terminals. One
/// thread, one poll(). All links go when it is destroyed. The folders of the links are locked: one
/// rig a folder.
class RigServer {
 public:
  /// `rig` and `clock` must outlive the server.
  /// @param time_scale  clock seconds in a second of ours: how long to wait in poll().
  [[nodiscard]] static Result<RigServer> open(SimulatedRig& rig, Clock& clock,
                                              const RigEndpoints& endpoints, double time_scale);
  RigServer(RigServer&&) noexcept = default;
  RigServer& operator=(RigServer&&) = delete;
  RigServer(const RigServer&) = delete;
  RigServer& operator=(const RigServer&) = delete;
  ~RigServer() = default;

  [[nodiscard]] int port() const { return chamber_.port(); }
  [[nodiscard]] const std::vector<BoardPty>& boards() const { return boards_; }
  [[nodiscard]] std::size_t client_count() const { return chamber_.client_count(); }

  /// Serves until `stop` is readable.
  [[nodiscard]] Result<void> run(int stop);
  /// One turn: does what there is to do, having waited at most `wait` for it.
  [[nodiscard]] Result<void> serve_once(std::chrono::milliseconds wait) { return turn(wait, -1); }

 private:
  /// A folder of links: locked while it lives, removed afterwards if it was made here.
  class Folder {
   public:
    [[nodiscard]] static Result<Folder> open(const std::string& path);
    Folder(Folder&&) noexcept = default;
    Folder& operator=(Folder&&) = delete;
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;
    ~Folder();

   private:
    Folder(UniqueFd lock, std::string made) : lock_(std::move(lock)), made_(std::move(made)) {}
    UniqueFd lock_;
    std::string made_;  // empty: it was there before
  };

  RigServer(SimulatedRig& rig, Clock& clock, double time_scale, ModbusTcpServer chamber);
  [[nodiscard]] Result<void> open_boards(const std::vector<std::string>& links);
  [[nodiscard]] Result<void> turn(std::chrono::milliseconds wait, int stop);
  [[nodiscard]] std::chrono::milliseconds time_to_next_event() const;

  SimulatedRig& rig_;
  Clock& clock_;
  double time_scale_;
  ModbusTcpServer chamber_;
  std::vector<Folder> folders_;  // outlive the links in them
  std::vector<BoardPty> boards_;
  std::vector<pollfd> watched_;
};

}  // namespace gyrocal
