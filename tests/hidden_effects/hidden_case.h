#pragma once
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "tests/hidden_effects/setting.h"

namespace hidden {

struct Amplitude {
  double value;
  std::string unit;
  std::string means;
};

/// One thing hidden in a session, and how a finder's answer about it is to be judged.
struct Hidden {
  std::string name;
  std::string law;
  Amplitude amplitude;
  std::vector<Amplitude> also;  ///< other fair ways to state the size
  bool signed_amplitude = false;
  std::map<std::string, double> parameters;
  double smallest_detectable = 0.0;  ///< 0: not computed for this kind
  double gain_nats = 0.0;
  std::map<std::string, double> lead_nats;  ///< over each rival class, own mismatch taken off
  std::vector<std::string> confounded_with;
};

struct Case {
  std::string name;
  std::string category;  ///< single | pair | outside | null | confounded
  std::string level;     ///< strong | moderate | ""
  std::uint64_t seed = 0;
  std::string expected_verdict;
  std::vector<std::string> accepted_verdicts;
  std::vector<Hidden> effects;
  Setting setting;
  Chain chain;  ///< with what was hidden in it
  Trajectory over;
  Series added_dps;  ///< once a second, on top of the baseline over the felt temperature
  Series tilt_rad;
  double flicker_dps = 0.0;
  double walk_dps_per_root_s = 0.0;
};

/// Simulates the session, writes it into `folder`, and the truth into `truth_file`.
/// What only chance decided (shares of samples lost, stuck, ...) is filled in on the way.
/// @return empty when written, else what went wrong.
std::string write_case(Case hidden_case, const std::filesystem::path& folder,
                       const std::filesystem::path& truth_file);

}  // namespace hidden
