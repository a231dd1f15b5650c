#pragma once

#include <memory>
#include <optional>
#include <string>

#include "config/campaign.h"
#include "daemon/runner/campaign_runner.h"
#include "drivers/recording/recording_layers.h"

namespace gyrocal::runner {

/// "weekend.recording.db" beside "weekend.db".
[[nodiscard]] std::string recording_path(const std::string& database);

/// What a run begins with besides its campaign file: enough to do it again from the recording.
struct Circumstances {
  RunOptions options;            ///< all but `database`
  bool in_virtual_time = false;  ///< simulated devices in process
  std::string chamber_profile;   ///< the profile's file as read
  /// The campaign of the database that is gone on with: its number, state, and the latest time
  /// stored in it. Later rows are this run's.
  struct Resumed {
    std::int64_t campaign = 0;
    std::string state;
    std::int64_t t_last_ns = 0;
  };
  std::optional<Resumed> resumed;
  bool completes_trip = false;  ///< complete_trip() within options.stop_within, not run_campaign()
};

/// As RecordedRun::circumstances holds it: JSON.
[[nodiscard]] std::string to_json(const Circumstances& circumstances);
/// @return bad_frame: not such a text.
[[nodiscard]] Result<Circumstances> circumstances_from(const std::string& json);

/// What the loop is told from outside clock and links, by the words it is recorded under.
namespace input {
inline constexpr char stop[] = "be asked to stop";               ///< SIGTERM, SIGINT, SIGHUP
inline constexpr char command[] = "take an operator's command";  ///< an operator's: "pause"
inline constexpr char bytes_free[] =
    "look for room on the disk";                       ///< on the database's disk; empty: unknown
inline constexpr char begun[] = "begin the campaign";  ///< "CAMPAIGN T_NS", what the run begins at
inline constexpr char ended[] = "end the run";         ///< ended_text(); a killed run has none
inline constexpr char not_stored[] = "fail to store a row";  ///< to_text() of the error
}  // namespace input

/// "pause", and back. Only an operator's commands have a name.
[[nodiscard]] std::string command_text(const campaign::Event& command);
[[nodiscard]] std::optional<campaign::Event> command_named(const std::string& text);

/// What is recorded as input::begun.
[[nodiscard]] std::string begun_text(CampaignId campaign, Duration t);

/// How complete_trip() ended.
[[nodiscard]] std::string ended_text(const Result<void>& completed);

/// How a run ended, for comparison: "finished", "stopped while ramping", "safe: ...", an error.
[[nodiscard]] std::string ended_text(const Result<Outcome>& outcome);

/// The same hooks, with all they tell the loop recorded on its way.
[[nodiscard]] RunHooks recorded_hooks(RunHooks hooks, Recorder& recorder);

/// One run's part of the recording beside a database. If it cannot be written the campaign goes on
/// without it and is told so once, by RunHooks::trouble.
class RunRecording {
 public:
  RunRecording(const std::string& database, const RecordedRun& run, Duration flush_every);
  [[nodiscard]] RecordingWriter* writer() { return writer_.get(); }
  /// What keeps it from being written, the first time this is asked after it came up.
  [[nodiscard]] std::optional<Error> trouble();

 private:
  std::unique_ptr<RecordingWriter> writer_;
  std::optional<Error> trouble_;
  bool told_ = false;
};

}  // namespace gyrocal::runner
