#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "tests/bench/child_process.h"
#include "tests/bench/scratch.h"
#include "tests/bench/sections.h"

namespace gyrocal::bench {
namespace {

constexpr std::size_t sessions_max = 7;

/// Some sessions of the short set, evenly spread over it.
std::vector<std::string> chosen_sessions(const std::string& folder) {
  std::vector<std::string> all;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    all.push_back(entry.path().string());
  }
  std::sort(all.begin(), all.end());
  std::vector<std::string> chosen;
  const std::size_t step = std::max<std::size_t>(1, all.size() / sessions_max);
  for (std::size_t i = 0; i < all.size() && chosen.size() < sessions_max; i += step) {
    chosen.push_back(all[i]);
  }
  return chosen;
}

}  // namespace

Rows diagnose_rows() {
  const std::string job = "diagnose a session, wall";
  const Scratch folder;
  const auto made = run_child({GYROCAL_HIDDEN_SESSIONS, "--out", folder.path(), "--set", "short",
                               "--seed", "1", "--jobs", "2"});
  if (!made || made->exit_code != 0) return {failed(job, GYROCAL_HIDDEN_SESSIONS)};
  std::vector<double> wall_s, cpu_s, memory;
  for (const std::string& session : chosen_sessions(folder / "sessions")) {
    const auto ran = run_child({GYROCAL_PROGRAM, "diagnose", "--session", session, "--json"});
    if (!ran || ran->exit_code != 0) return {failed(job, session)};
    wall_s.push_back(ran->wall_s);
    cpu_s.push_back(ran->cpu_s);
    memory.push_back(ran->memory_bytes / 1e6);
  }
  const double most_mb = *std::max_element(memory.begin(), memory.end());
  return {within(job, spread_of(wall_s), 3.0,
                 fmt::format("{} sessions of gyrocal_hidden_sessions --set short", wall_s.size())),
          within("the same, CPU", spread_of(cpu_s), 3.0,
                 "one thread: the wall time of an idle machine"),
          number("the same: most memory of any", shown(most_mb, "MB"), "<= 256 MB", most_mb <= 256,
                 "")};
}

}  // namespace gyrocal::bench
