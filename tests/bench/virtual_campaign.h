#pragma once

#include <string>
#include <utility>
#include <vector>

#include "compensation/values/error.h"
#include "tests/bench/child_process.h"

namespace gyrocal::bench {

/// Lines of config/campaigns/demo.toml to have otherwise: {"soak_s_min = 420", "soak_s_min =
/// 1500"}.
using Changes = std::vector<std::pair<std::string, std::string>>;

/// The demo's campaign file with these changes, written to `path`. bad_input: no such line.
[[nodiscard]] Result<void> write_campaign_file(const std::string& path, const Changes& changes);

/// What a campaign in virtual time took and made.
struct VirtualRun {
  ChildResult process;
  double campaign_s = 0;  ///< virtual
  double frames = 0;      ///< sent by the boards while the slow stream ran
  double samples = 0;     ///< stored
};
/// `gyrocal run FILE --virtual --db DATABASE` in a process of its own; DATABASE must not exist.
[[nodiscard]] Result<VirtualRun> run_virtual(const std::string& file, const std::string& database,
                                             bool record);

/// Decodes the boards' bytes of a recording: the file read and unpacked, frames found, checked and
/// counted.
struct Decoded {
  double cpu_s = 0;
  double frames = 0;
};
[[nodiscard]] Result<Decoded> decode_recording(const std::string& recording);

}  // namespace gyrocal::bench
