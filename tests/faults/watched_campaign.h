#pragma once

#include <deque>
#include <string>
#include <vector>

#include "daemon/runner/campaign_runner.h"
#include "tests/faults/fault_schedule.h"
#include "tests/faults/invariants.h"
#include "tests/faults/world.h"

namespace gyrocal::faults {

/// The daemon under systemd in virtual time, from its first start to the end of its campaign, with
/// a schedule of faults. Throws Broken.
class WatchedCampaign {
 public:
  /// @param database  where none is yet.
  WatchedCampaign(const Schedule& schedule, std::uint64_t seed, std::string database,
                  Checks& checks);

  /// @return "finished", "aborted", "safe", or "never began" where a device was away for good.
  std::string run();

  [[nodiscard]] const std::vector<std::string>& log() const { return log_; }
  [[nodiscard]] Instant lasted() const { return world_.now(); }
  [[nodiscard]] int faults_begun() const { return faults_begun_; }
  [[nodiscard]] int crashes() const { return crashes_; }
  /// Warnings and errors it told of.
  [[nodiscard]] int alarms() const { return alarms_; }
  [[nodiscard]] std::size_t dwells() const { return acknowledged_.dwells(); }

 private:
  // The world's part.
  void begin(const PlannedFault& planned);
  void begin_rig(RigFault fault);
  void begin_host(const HostFault& fault);
  void await_triggers(const runner::Snapshot& now);

  // systemd's part.
  [[nodiscard]] std::optional<std::string> one_process();
  [[nodiscard]] std::optional<std::string> ended_before(const Store& store) const;
  [[nodiscard]] std::optional<std::string> left_alone(const std::string& state, Store& store);
  [[nodiscard]] Result<runner::Outcome> daemon(Drivers& drivers, Store& store);
  void make_safe();
  void close_ports();
  void rest(double for_s) { world_.sleep_until(world_.now() + seconds(for_s)); }

  // The watcher's part.
  void wrote(const modbus::Request& request);
  void told(const EventInsert& event);
  void seen(const runner::Snapshot& now, const Store& store);
  void check_end(const std::string& state);

  const Schedule& schedule_;
  std::string database_;
  Checks& checks_;
  CampaignConfig config_;
  World world_;
  Host host_;
  SimulatedRig rig_;

  std::deque<PlannedFault> awaited_;
  std::deque<campaign::Event> commands_;
  bool stop_asked_ = false;
  bool power_gone_ = false;
  double restart_after_s_ = 2;
  std::uintmax_t bytes_free_;
  int wire_faults_ = 0;  ///< of the chamber, at this moment
  int lies_ = 0;         ///< of its thermometer

  JournalCheck journal_;
  AcknowledgedCheck acknowledged_;
  std::vector<TrueAir> true_air_;
  std::vector<std::string> log_;
  std::string state_;
  std::optional<Instant> trip_;  ///< the safe setpoint is awaited
  bool excused_ = false;         ///< the wire or the process was not there to send it
  bool hands_off_ = false;
  bool panel_touched_ = false;  ///< since the last write
  int faults_begun_ = 0;
  int crashes_ = 0;
  int alarms_ = 0;
  int failed_starts_ = 0;
};

}  // namespace gyrocal::faults
