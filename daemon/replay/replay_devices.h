#pragma once

#include <deque>
#include <memory>
#include <string>

#include "config/campaign.h"
#include "daemon/runner/preflight.h"
#include "daemon/runner/run_recording.h"
#include "drivers/board/inemo_board.h"
#include "drivers/chamber/modbus_chamber.h"
#include "drivers/recording/replay_layers.h"

namespace gyrocal::replay {

/// The links of a recorded run, answering as they did then, under today's drivers.
class ReplayDevices {
 public:
  /// @param begun  how the run was; decides the timing of the drivers.
  /// @return mismatch: the campaign has a board whose link was not recorded; what reading returns.
  [[nodiscard]] static Result<std::unique_ptr<ReplayDevices>> open(
      const std::string& recording, const RecordedRun& run, const CampaignConfig& config,
      const runner::Circumstances& begun);
  ReplayDevices(const ReplayDevices&) = delete;
  ReplayDevices& operator=(const ReplayDevices&) = delete;

  [[nodiscard]] Tape& tape() { return tape_; }
  [[nodiscard]] runner::Devices devices();

 private:
  ReplayDevices(RecordingReader reader, const RecordedRun& run, const CampaignConfig& config,
                const runner::Circumstances& begun);

  Tape tape_;
  ReplayClock clock_;
  ReplayRequestLink chamber_link_;
  ModbusChamber chamber_;
  std::deque<ReplayByteLink> board_links_;  // drivers hold references: no reallocation
  std::deque<InemoBoard> boards_;
};

}  // namespace gyrocal::replay
