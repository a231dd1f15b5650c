#include <deque>

#include "daemon/runner/owned_devices.h"
#include "drivers/board/inemo_board.h"
#include "drivers/chamber/modbus_chamber.h"
#include "drivers/clocks.h"
#include "drivers/simulated/in_process_links.h"
#include "drivers/simulated/simulated_rig.h"

namespace gyrocal::runner {
namespace {

/// 2026-01-01T00:00:00Z: a virtual campaign begins at no particular time, always the same one.
constexpr std::int64_t virtual_utc_start_ns = 1'767'225'600'000'000'000;

class VirtualDevices final : public OwnedDevices {
 public:
  VirtualDevices(const CampaignConfig& config, const rig::RigModel& model, std::uint64_t seed)
      : clock_(virtual_utc_start_ns),
        rig_(model, seed, config.boards.size(), config.chamber.profile, config.chamber.unit),
        chamber_link_(rig_.chamber(), clock_, seconds(config.chamber.reply_timeout_s)),
        chamber_(chamber_link_, clock_, config.chamber.profile, config.chamber.unit) {
    for (std::size_t i = 0; i < config.boards.size(); ++i) {
      board_links_.emplace_back(rig_.board(i), clock_);
      boards_.emplace_back(board_links_.back(), clock_, config.boards[i].name);
    }
  }

  Devices devices() override {
    std::vector<Board*> boards;
    for (auto& board : boards_) boards.push_back(&board);
    return {clock_, chamber_, std::move(boards)};
  }

 private:
  VirtualClock clock_;
  SimulatedRig rig_;
  InProcessChamberLink chamber_link_;
  ModbusChamber chamber_;
  std::deque<InProcessBoardLink> board_links_;  // drivers hold references: no reallocation
  std::deque<InemoBoard> boards_;
};

}  // namespace

std::unique_ptr<OwnedDevices> virtual_devices(const CampaignConfig& config,
                                              const rig::RigModel& model, std::uint64_t seed) {
  return std::make_unique<VirtualDevices>(config, model, seed);
}

}  // namespace gyrocal::runner
