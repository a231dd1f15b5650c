#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "compensation/values/error.h"
#include "daemon/replay/decision_check.h"

namespace gyrocal::replay {

struct ReplayRequest {
  std::string recording;
  /// The database the recorded campaign wrote; absent: the one inside a capsule, else the one
  /// beside the recording.
  std::optional<std::string> against{};
  /// A campaign file to decide by instead of the recorded one, with the same boards. The recorded
  /// chamber profile stays: it is what the recorded transactions mean.
  std::optional<std::string> campaign{};
};

/// One run of the recording, done again.
struct ReplayedRun {
  std::int64_t number = 0;
  std::string software_version;            ///< that recorded it
  std::optional<std::int64_t> campaign{};  ///< in the database; absent: preflight did not pass
  Duration from{};                         ///< campaign time
  Duration to{};
  std::string ended;     ///< how; empty: cut off
  bool cut_off = false;  ///< the recording ends before the run did: a crash, a full disk, a capsule
  TapeCounts passed{};   ///< the links, to the byte as recorded
  std::int64_t decisions = 0;  ///< rows alike, from here on
  std::int64_t dwells = 0;
  std::int64_t samples = 0;
  std::int64_t monitor_rows = 0;
  std::int64_t models = 0;
  std::int64_t unchecked_rows = 0;  ///< stored after the recording's end, which nothing tells about
  bool operator==(const ReplayedRun&) const = default;
};

struct ReplayReport {
  std::string recording;
  std::string against;
  std::vector<ReplayedRun> runs;  ///< up to the one that differs
  std::optional<Difference> difference;
  bool repeatable = true;  ///< a second replay did the same to the last bit
  [[nodiscard]] bool passed() const { return !difference && repeatable; }
};

/// Runs what was recorded through today's drivers, state machine, store and analysis, without
/// waiting, twice; compares what passes the links, the journal, dwells, samples, slow stream and
/// models with the database that the recorded campaign wrote. A resumed run begins with what that
/// database held when it was resumed. Writes to a temporary folder only.
/// @return storage, mismatch, bad_frame: files that are missing, foreign, newer or damaged;
///   bad_input: no run in the recording; what parsing the campaign returns.
[[nodiscard]] Result<ReplayReport> replay(const ReplayRequest& request);

[[nodiscard]] std::string report_text(const ReplayReport& report);
[[nodiscard]] std::string report_json(const ReplayReport& report,
                                      const std::string& software_version);
/// JUnit XML as GitLab, Jenkins and GitHub's reporters read it: one test case a run, one for the
/// second replay.
[[nodiscard]] std::string report_junit(const ReplayReport& report);

}  // namespace gyrocal::replay
