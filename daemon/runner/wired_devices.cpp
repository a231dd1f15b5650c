#include <deque>

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
  explicit WiredDevices(const CampaignConfig& config)
      : clock_(config.time_scale),
        chamber_link_(config.chamber.address, seconds(config.chamber.reply_timeout_s), clock_),
        chamber_(chamber_link_, clock_, config.chamber.profile, config.chamber.unit) {
    const BoardTiming timing = BoardTiming::for_time_scale(config.time_scale);
    for (const auto& board : config.boards) {
      board_links_.emplace_back(board.device);
      boards_.emplace_back(board_links_.back(), clock_, board.name, timing);
    }
  }

  Devices devices() override {
    std::vector<Board*> boards;
    for (auto& board : boards_) boards.push_back(&board);
    return {clock_, chamber_, std::move(boards)};
  }

 private:
  ScaledClock clock_;
  ModbusLink chamber_link_;
  ModbusChamber chamber_;
  std::deque<SerialLink> board_links_;  // drivers hold references: no reallocation
  std::deque<InemoBoard> boards_;
};

}  // namespace

std::unique_ptr<OwnedDevices> wired_devices(const CampaignConfig& config) {
  return std::make_unique<WiredDevices>(config);
}

}  // namespace gyrocal::runner
