#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "compensation/rig/chamber_air.h"
#include "compensation/rig/rig_model.h"
#include "config/chamber_profile.h"
#include "config/rig_faults.h"
#include "drivers/simulated/simulated_board.h"
#include "drivers/simulated/simulated_chamber.h"

namespace gyrocal {

/// A chamber and the boards in it. One thread uses a rig, with one clock. The air is known in
/// closed form from the commands the chamber got, and each board follows it on a time grid of its
/// own, so it makes no difference who is asked first or how often.
///
///   VirtualClock clock;
///   SimulatedRig rig(rig::RigModel{}, 7, 2, profile, 1);
///   InProcessChamberLink chamber(rig.chamber(), clock, std::chrono::seconds(1));
///   InProcessBoardLink board(rig.board(0), clock);
class SimulatedRig {
 public:
  /// @param seed  of the noise; a board's identity comes from its index and stays.
  SimulatedRig(const rig::RigModel& model, std::uint64_t seed, std::size_t board_count,
               const ChamberProfile& profile, int unit,
               std::size_t output_bytes_max = std::numeric_limits<std::size_t>::max());
  SimulatedRig(const SimulatedRig&) = delete;
  SimulatedRig& operator=(const SimulatedRig&) = delete;
  SimulatedRig(SimulatedRig&&) = delete;
  SimulatedRig& operator=(SimulatedRig&&) = delete;
  ~SimulatedRig() = default;

  /// What goes wrong, and when. To be given before time begins.
  void set_faults(std::vector<RigFault> faults);
  /// Lets everything happen that is due by `now`. The devices do it themselves when they are asked.
  void reach(Instant now);
  /// When the next fault begins or ends.
  [[nodiscard]] std::optional<Instant> next_fault() const;

  [[nodiscard]] SimulatedChamber& chamber() { return chamber_; }
  [[nodiscard]] std::size_t board_count() const { return boards_.size(); }
  [[nodiscard]] SimulatedBoard& board(std::size_t index) { return *boards_.at(index); }

 private:
  struct Turn {
    Instant at;
    bool begins;
    RigFault fault;
  };
  void happen(const Turn& turn);

  rig::ChamberAir air_;
  SimulatedChamber chamber_;
  std::vector<std::unique_ptr<SimulatedBoard>> boards_;
  std::vector<Turn> turns_;  // in time order
  std::size_t turns_done_ = 0;
  bool reaching_ = false;
};

/// Board `index`'s id: 12 bytes in the manner of an STM32F103's, the index at the end.
[[nodiscard]] McuId simulated_mcu_id(std::size_t index);

}  // namespace gyrocal
