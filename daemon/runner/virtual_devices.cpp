#include <deque>

#include "daemon/runner/link_layers.h"
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
  VirtualDevices(const CampaignConfig& config, const rig::RigModel& model, std::uint64_t seed,
                 RecordingWriter* writer)
      : clock_(virtual_utc_start_ns),
        layers_(clock_, writer),
        rig_(model, seed, config.boards.size(), config.chamber.profile, config.chamber.unit),
        chamber_link_(rig_.chamber(), clock_, seconds(config.chamber.reply_timeout_s)),
        chamber_(layers_.over(chamber_link_), layers_.clock(), config.chamber.profile,
                 config.chamber.unit) {
    for (std::size_t i = 0; i < config.boards.size(); ++i) {
      board_links_.emplace_back(rig_.board(i), clock_);
      boards_.emplace_back(layers_.over(board_links_.back()), layers_.clock());
    }
  }

  Devices devices() override {
    std::vector<Board*> boards;
    for (auto& board : boards_) boards.push_back(&board);
    return {layers_.clock(), chamber_, std::move(boards)};
  }
  Recorder* recorder() override { return layers_.recorder(); }

 private:
  VirtualClock clock_;
  LinkLayers layers_;
  SimulatedRig rig_;
  InProcessChamberLink chamber_link_;
  ModbusChamber chamber_;
  std::deque<InProcessBoardLink> board_links_;  // drivers hold references: no reallocation
  std::deque<InemoBoard> boards_;
};

}  // namespace

std::unique_ptr<OwnedDevices> virtual_devices(const CampaignConfig& config,
                                              const rig::RigModel& model, std::uint64_t seed,
                                              RecordingWriter* writer) {
  return std::make_unique<VirtualDevices>(config, model, seed, writer);
}

}  // namespace gyrocal::runner
