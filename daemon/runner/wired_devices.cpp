#include <deque>

#include "daemon/runner/link_layers.h"
#include "daemon/runner/owned_devices.h"
#include "drivers/board/inemo_board.h"
#include "drivers/board/serial_link.h"
#include "drivers/chamber/modbus_chamber.h"
#include "drivers/chamber/modbus_link.h"
#include "drivers/clocks.h"

namespace gyrocal::runner {
namespace {

class WiredDevices final : public OwnedDevices {
 public:
  WiredDevices(const CampaignConfig& config, RecordingWriter* writer)
      : clock_(config.time_scale),
        layers_(clock_, writer),
        chamber_link_(config.chamber.address, seconds(config.chamber.reply_timeout_s), clock_),
        chamber_(layers_.over(chamber_link_), layers_.clock(), config.chamber.profile,
                 config.chamber.unit) {
    const BoardTiming timing = BoardTiming::for_time_scale(config.time_scale);
    for (const auto& board : config.boards) {
      board_links_.emplace_back(board.device);
      boards_.emplace_back(layers_.over(board_links_.back()), layers_.clock(), timing);
    }
  }

  Devices devices() override {
    std::vector<Board*> boards;
    for (auto& board : boards_) boards.push_back(&board);
    return {layers_.clock(), chamber_, std::move(boards)};
  }
  Recorder* recorder() override { return layers_.recorder(); }

 private:
  ScaledClock clock_;
  LinkLayers layers_;
  ModbusLink chamber_link_;
  ModbusChamber chamber_;
  std::deque<SerialLink> board_links_;  // drivers hold references: no reallocation
  std::deque<InemoBoard> boards_;
};

}  // namespace

std::unique_ptr<OwnedDevices> wired_devices(const CampaignConfig& config, RecordingWriter* writer) {
  return std::make_unique<WiredDevices>(config, writer);
}

}  // namespace gyrocal::runner
