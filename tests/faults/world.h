#pragma once

#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <vector>

#include "config/campaign.h"
#include "drivers/board/inemo_board.h"
#include "drivers/chamber/modbus_chamber.h"
#include "drivers/clock.h"
#include "drivers/simulated/in_process_links.h"
#include "drivers/simulated/simulated_rig.h"

namespace gyrocal::faults {

/// Thrown through the daemon at a call of one of its seams: its process is gone at this instant.
/// Nothing of it runs any more but destructors, which reach no device.
struct Crashed {};
/// The daemon does not come to an end.
struct Hung {};

/// True time, in which things happen at their own instants whoever sleeps.
class World final : public Clock {
 public:
  [[nodiscard]] Instant now() const override { return now_; }
  void sleep_until(Instant when) override;
  [[nodiscard]] std::int64_t utc_ns() const override;
  void at(Instant when, std::function<void()> deed) { deeds_.emplace(when, std::move(deed)); }

 private:
  Instant now_{};
  std::multimap<Instant, std::function<void()>> deeds_;
};

/// The clocks of the daemon's machine, and the machine's end.
class Host final : public Clock {
 public:
  explicit Host(World& world) : world_(world) {}
  [[nodiscard]] Instant now() const override { return world_.now() - slept_; }
  void sleep_until(Instant when) override;
  [[nodiscard]] std::int64_t utc_ns() const override { return world_.utc_ns() + utc_off_ns_; }

  void sleep_machine(Duration how_long);  ///< its steady clock stands still meanwhile
  void step_utc(double by_s) { utc_off_ns_ += seconds(by_s).count(); }
  /// The process dies at the n-th call of a seam from now.
  void crash_after(int calls) { calls_left_ = calls; }
  void not_crashing() { calls_left_.reset(); }
  /// One call of a seam.
  void step();

 private:
  World& world_;
  Duration slept_{};
  std::int64_t utc_off_ns_ = 0;
  std::optional<int> calls_left_;
};

/// The links of one process, watched: its writes are told, and it can die at any call.
class WatchedRequestLink final : public RequestLink {
 public:
  using OnWrite = std::function<void(const modbus::Request&)>;
  WatchedRequestLink(RequestLink& target, Host& host, OnWrite on_write)
      : target_(target), host_(host), on_write_(std::move(on_write)) {}
  [[nodiscard]] Result<Bytes> transact(std::span<const std::uint8_t> request) override;

 private:
  RequestLink& target_;
  Host& host_;
  OnWrite on_write_;
};

class WatchedByteLink final : public ByteLink {
 public:
  WatchedByteLink(SimulatedBoard& board, World& world, Host& host)
      : target_(board, world), host_(host) {}
  [[nodiscard]] Result<std::size_t> read(std::span<std::uint8_t> into) override;
  [[nodiscard]] Result<void> write(std::span<const std::uint8_t> bytes) override;
  [[nodiscard]] Result<void> reopen() override;

 private:
  InProcessBoardLink target_;
  Host& host_;
};

/// The drivers of one process over the rig.
class Drivers {
 public:
  Drivers(const CampaignConfig& config, SimulatedRig& rig, World& world, Host& host,
          WatchedRequestLink::OnWrite on_write);
  [[nodiscard]] Chamber& chamber() { return chamber_; }
  [[nodiscard]] std::vector<Board*> boards();

 private:
  InProcessChamberLink wire_;
  WatchedRequestLink link_;
  ModbusChamber chamber_;
  std::deque<WatchedByteLink> board_links_;  // boards hold references: no reallocation
  std::deque<InemoBoard> boards_;
};

}  // namespace gyrocal::faults
