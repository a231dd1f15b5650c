// Campaigns with random faults in virtual time, judged by what must hold whatever happens.
//   fault_campaigns COUNT [FIRST]     seeds FIRST, FIRST + 1, ...; a single one tells what it does
//   fault_campaigns clean COUNT [FIRST]
// The same without the faults: chambers of 0.5 to 3 times the usual speed finish without a warning.
#include <fmt/core.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <string_view>

#include "tests/daemon/runner/temporary_folder.h"
#include "tests/faults/watched_campaign.h"

namespace gyrocal::faults {
namespace {

struct Sum {
  std::map<std::string, int> endings;
  double hours = 0;
  int faults = 0;
  int crashes = 0;
  int alarms = 0;
  std::size_t dwells = 0;
};

void tell(const Schedule& schedule, const WatchedCampaign& campaign) {
  fmt::print("{}{}", schedule.campaign, to_text(schedule));
  for (const auto& line : campaign.log()) fmt::print("{}\n", line);
}

bool run_one(std::uint64_t seed, bool clean, bool telling, Checks& checks, Sum& sum) {
  const runner::TemporaryFolder folder;
  Schedule schedule = draw_schedule(seed);
  if (clean) schedule.faults.clear();
  WatchedCampaign campaign(schedule, seed, folder / "faults.db", checks);
  try {
    const std::string ending = campaign.run();
    ++sum.endings[ending];
    sum.alarms += campaign.alarms();
    if (clean) checks.require(campaign.alarms() == 0, "nothing wrong, no alarm", ending);
    if (clean) checks.require(ending == "finished", "nothing wrong, it finishes", ending);
  } catch (const Broken& broken) {
    tell(schedule, campaign);
    fmt::print("seed {}: broken: {}\nto repeat it: fault_campaigns {}1 {}\n", seed, broken.what,
               clean ? "clean " : "", seed);
    return false;
  }
  if (telling) tell(schedule, campaign);
  sum.hours += to_seconds(campaign.lasted().time_since_epoch()) / 3600;
  sum.faults += campaign.faults_begun();
  sum.crashes += campaign.crashes();
  sum.dwells += campaign.dwells();
  return true;
}

int run(bool clean, std::uint64_t count, std::uint64_t first) {
  // What is tested here reaches no disk: a commit need not wait for one.
  if (std::filesystem::is_directory("/dev/shm")) ::setenv("TMPDIR", "/dev/shm", 0);
  const auto began = std::chrono::steady_clock::now();
  Checks checks;
  Sum sum;
  int broken = 0;
  for (std::uint64_t seed = first; seed < first + count; ++seed) {
    broken += !run_one(seed, clean, count == 1, checks, sum);
  }
  fmt::print("{} campaigns from seed {}, {} broken:", count, first, broken);
  for (const auto& [ending, times] : sum.endings) fmt::print(" {} {},", times, ending);
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - began;
  fmt::print(
      " {} faults, {} warnings, {} crashes and power cuts, {} accepted dwells, {} promises "
      "checked, {:.0f} h of campaign time in {:.1f} s\n",
      sum.faults, sum.alarms, sum.crashes, sum.dwells, checks.count(), sum.hours, took.count());
  return broken == 0 ? 0 : 1;
}

}  // namespace
}  // namespace gyrocal::faults

int main(int argc, char** argv) {
  const auto number = [&](int i, std::uint64_t otherwise) {
    return argc > i ? std::strtoull(argv[i], nullptr, 10) : otherwise;
  };
  const bool clean = argc > 1 && std::string_view(argv[1]) == "clean";
  return gyrocal::faults::run(clean, number(1 + clean, 100), number(2 + clean, 1));
}
