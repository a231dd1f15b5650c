#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "config/campaign.h"
#include "daemon/campaign/campaign.h"
#include "daemon/runner/journal.h"
#include "daemon/runner/preflight.h"
#include "daemon/runner/slow_stream.h"
#include "schema/store.h"

namespace gyrocal::runner {

/// One board of a running campaign.
struct BoardSnapshot {
  std::string name;
  bool present = false;
  bool given_up = false;     ///< away for too long: the campaign goes on without it
  std::string trouble;       ///< why it is away
  std::uint64_t frames = 0;  ///< since this run began, as are the next two
  std::uint64_t frames_missing = 0;
  std::uint64_t restarts = 0;
  std::optional<SlowInterval> latest;   ///< of its slow stream, as sent; absent: none yet
  std::optional<double> slope_k_per_h;  ///< of its temperature; absent: its window is not full
};

/// Where a campaign stands, for a progress line, a status command, a watchdog, a page.
struct Snapshot {
  Duration t{};       ///< campaign time
  std::string state;  ///< name of the state
  std::string text;   ///< describe(state)
  std::string why;    ///< it holds, or has tripped
  Duration since{};   ///< when the state began
  std::size_t setpoints = 0;
  std::size_t setpoints_done = 0;
  std::optional<Celsius> air;
  std::optional<Celsius> setpoint;    ///< what the chamber says it controls to
  std::optional<double> dwell_share;  ///< of the samples of the running dwell
  Duration left{};                    ///< estimate to the end
  Duration left_max{};                ///< the same with the waits a chamber's cycling may cost
  Duration chamber_age{};             ///< since the last believed reading
  int boards_present = 0;
  int boards = 0;
  std::vector<BoardSnapshot> each_board;  ///< in the order of the campaign file
};

/// What the runner is told and whom it tells; everything may be left empty.
struct RunHooks {
  std::function<bool()> stop_asked;                              ///< SIGTERM, SIGINT
  std::function<std::optional<campaign::Event>()> next_command;  ///< an operator's
  std::function<void(const Snapshot&)> progress;                 ///< every turn of the loop
  LogLine log;
  std::function<std::optional<std::uintmax_t>()> bytes_free;  ///< on the database's disk
  std::function<std::optional<Error>()> trouble;  ///< of its recording: told once, changes nothing
  std::function<void(CampaignId, Duration t)> begun;  ///< preflight has passed; it goes on from t
  StoreWatch storing;  ///< an error of may_store ends the run, as a full disk does
};

struct RunOptions {
  std::string software_version;
  Duration tick{};         ///< how often the loop turns
  Duration patience{};     ///< for a board's first frame
  Duration stop_within{};  ///< to get the safe setpoint confirmed after stop_asked
  std::size_t monitor_rows_per_write = 24;
  double utc_rate = 1;  ///< seconds of campaign time in one of UTC
  bool resume = false;  ///< go on with the database's campaign if it has not ended
};

struct Outcome {
  CampaignId campaign{};
  campaign::State state;
  bool stopped = false;  ///< by stop_asked: not ended, can be resumed
};

/// Runs a whole campaign, from preflight to stored models, in this thread: drain the boards, poll
/// the chamber, feed the state machine, act, store, sleep. Nothing is written to the chamber before
/// preflight has passed, nor to the database.
/// @return how it ended. busy: the database holds a campaign that has not ended, and resume is not
///   asked for. Any other error means
///   that it did not begin (preflight), or that the database failed on the way: then the chamber
///   has been sent to its safe setpoint.
[[nodiscard]] Result<Outcome> run_campaign(const CampaignConfig& config, Devices devices,
                                           Store& store, const RunOptions& options,
                                           const RunHooks& hooks);

}  // namespace gyrocal::runner
