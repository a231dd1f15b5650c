// Jobs whose growth is measured in processes of their own, for their memory.
#include <fmt/format.h>

#include <cmath>

#include "tests/bench/growth.h"
#include "tests/bench/scratch.h"
#include "tests/bench/virtual_campaign.h"

namespace gyrocal::bench {
namespace {

struct Size {
  const char* setpoints;
  double soak_s;
};
/// Five setpoints and the paper's, from the demo's soak to one that makes it 1000 hours.
constexpr Size sizes[] = {{"setpoints_c = [22, 23, 24, 25, 26]\n", 420},
                          {"", 420},
                          {"", 1500},
                          {"", 15000},
                          {"", 143000}};

void note(Growth& growth, double work, const ChildResult& process) {
  growth.work.push_back(work);
  growth.cpu_s.push_back(process.cpu_s);
  growth.memory_bytes.push_back(process.memory_bytes);
}

void note_program(Growth& growth, double work, const std::vector<std::string>& command) {
  const auto ran = run_child(command);
  if (ran && ran->exit_code == 0) return note(growth, work, *ran);
  growth.trouble = fmt::format("{} {} failed", command[0], command[1]);
}

}  // namespace

std::vector<Growth> campaign_growth() {
  Growth virtual_time{"campaign in virtual time, 2 boards", "h", {}, {}};
  Growth replay{"replay of its recording", "h", {}, {}};
  Growth diagnose{"diagnose one axis of it", "h", {}, {}};
  const Scratch folder;
  for (const Size& size : sizes) {
    const std::string name =
        folder / fmt::format("{}{}", *size.setpoints ? "few" : "", size.soak_s);
    const auto written = write_campaign_file(
        name + ".toml", {{"soak_s_min = 420", fmt::format("soak_s_min = {}", size.soak_s)},
                         {"soak_s_max = 3600", fmt::format("soak_s_max = {}", size.soak_s + 3600)},
                         {"sweep = \"up\"", fmt::format("{}sweep = \"up\"", size.setpoints)}});
    const auto run = written ? run_virtual(name + ".toml", name + ".db", false)
                             : tl::unexpected(written.error());
    if (!run) {
      virtual_time.trouble = run.error().what;
      continue;
    }
    const double hours = std::round(run->campaign_s / 3600);
    note(virtual_time, hours, run->process);
    note_program(diagnose, hours,
                 {GYROCAL_PROGRAM, "diagnose", "--db", name + ".db", "--board", "board0", "--axis",
                  "z", "--json"});
    const auto recorded = run_virtual(name + ".toml", name + "r.db", true);
    if (!recorded) replay.trouble = recorded.error().what;
    note_program(replay, hours, {GYROCAL_PROGRAM, "replay", name + "r.recording.db"});
  }
  return {virtual_time, replay, diagnose};
}

}  // namespace gyrocal::bench
