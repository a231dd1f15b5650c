#pragma once

#include <memory>
#include <vector>

#include "daemon/campaign/conditions.h"
#include "daemon/campaign/pace.h"
#include "daemon/campaign/sensor_freeze.h"
#include "daemon/campaign/supervisor.h"
#include "daemon/runner/board_port.h"
#include "daemon/runner/campaign_runner.h"
#include "daemon/runner/chamber_port.h"
#include "daemon/runner/chamber_track.h"
#include "daemon/runner/dwell_collector.h"
#include "daemon/runner/machine_watch.h"
#include "daemon/runner/slow_stream.h"

namespace gyrocal::runner {

/// The turning part of run_campaign(), after preflight: one turn after the other until the
/// campaign has ended or is told to stop.
class CampaignLoop {
 public:
  struct Begin {
    CampaignId campaign{};
    std::vector<BoardId> boards{};
    Duration t{};                               ///< campaign time now
    Instant origin{};                           ///< the clock's time at campaign time 0
    campaign::Event first;                      ///< Ready or NothingLeft
    std::vector<std::vector<bool>> accepted{};  ///< [setpoint][board]: has its dwell
    std::string resumed{};                      ///< what an earlier run left; empty: a new campaign
  };

  CampaignLoop(const CampaignConfig& config, const campaign::Plan& plan, Devices& devices,
               const Found& found, Store& store, const RunOptions& options, const RunHooks& hooks,
               Begin begin);

  [[nodiscard]] Result<Outcome> run();

 private:
  struct BoardSide {
    BoardId id;
    BoardPort port;
    SlowStream slow;
    campaign::Presence presence = campaign::Presence::expected;
    std::vector<SlowInterval> waiting{};  ///< closed, not yet merged with the chamber's readings
    campaign::Soak soak{};                ///< that led to the running dwell
    campaign::SensorFreeze freeze{};
    bool frozen = false;  ///< its temperature is read in breaks, not in the stream
    double break_c = missing;
    std::optional<SlowInterval> latest{};  ///< the newest with a frame in it
  };

  [[nodiscard]] Duration now() const { return devices_.clock.now() - begin_.origin; }

  // One turn.
  [[nodiscard]] Result<void> turn();
  [[nodiscard]] Result<void> read_boards();
  [[nodiscard]] Result<void> note_presence(std::size_t board);
  [[nodiscard]] Result<void> read_chamber();
  [[nodiscard]] Result<void> note_doubt();
  [[nodiscard]] Result<void> drive_chamber();
  [[nodiscard]] Result<void> watch_machine();
  [[nodiscard]] Result<void> judge();
  [[nodiscard]] Result<void> write_slow_stream();
  [[nodiscard]] Result<void> take_intervals(std::size_t board);
  [[nodiscard]] Result<void> note_freeze(std::size_t board);
  void read_frozen_temperatures();
  [[nodiscard]] Result<void> write_interval(const BoardSide& side, const SlowInterval& interval);

  // What follows from an event.
  [[nodiscard]] Result<void> feed(const campaign::Event& event);
  [[nodiscard]] Result<void> act(const campaign::Action& action);
  void begin_dwell(const campaign::Visit& visit);
  [[nodiscard]] Result<void> store_dwell(const std::optional<std::string>& reject_reason);
  [[nodiscard]] Result<void> store_skip(const campaign::Visit& visit);
  [[nodiscard]] DwellRow row_of(const CollectedDwell& dwell) const;
  [[nodiscard]] Result<void> analyse();

  // The ends.
  [[nodiscard]] Result<void> turn_safing();
  [[nodiscard]] Result<void> reach_safety();
  [[nodiscard]] Result<void> stop();

  [[nodiscard]] std::optional<campaign::Event> dwell_event();
  [[nodiscard]] std::optional<campaign::Event> presence_event() const;
  void note_pace(const campaign::State& before);
  [[nodiscard]] Duration planned_left() const;
  [[nodiscard]] Snapshot snapshot() const;
  [[nodiscard]] BoardSnapshot snapshot_of(std::size_t board) const;

  const CampaignConfig& config_;
  campaign::Plan plan_;
  Devices& devices_;
  Store& store_;
  RunOptions options_;
  RunHooks hooks_;
  Begin begin_;
  Journal journal_;
  ChamberPort chamber_;
  ChamberTrack track_;
  std::vector<BoardSide> boards_;
  campaign::Conditions conditions_;
  campaign::Supervisor supervisor_;
  DwellCollector collector_;
  campaign::Visit dwell_visit_;
  campaign::State state_ = campaign::Preflight{};
  campaign::Pace pace_;
  Duration entered_{};       ///< when state_ began
  std::size_t reached_ = 0;  ///< the setpoint it was about last
  bool chamber_was_away_ = false;
  int doubtful_told_ = 0;
  Duration doubt_told_ = Duration::min();
  MachineWatch machine_;
  Duration next_machine_look_ = Duration::min();
  std::vector<BoardSample> fresh_;
};

}  // namespace gyrocal::runner
