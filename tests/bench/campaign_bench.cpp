#include <fmt/format.h>

#include "tests/bench/scratch.h"
#include "tests/bench/sections.h"
#include "tests/bench/virtual_campaign.h"
#include "tests/daemon/campaign/clean_campaign.h"

namespace gyrocal::bench {
namespace {

constexpr int campaign_rounds = 5;
const char job[] = "virtual campaign: 25 setpoints, 2 boards, wall";

std::string described(const VirtualRun& run) {
  return fmt::format("{:.1f} h, {:.0f} frames, {:.0f} samples stored", run.campaign_s / 3600,
                     run.frames, run.samples);
}

Rows virtual_rows(const std::string& file, const Scratch& folder) {
  std::vector<double> wall_s;
  std::vector<double> cpu_s;
  VirtualRun last;
  for (int round = 0; round < campaign_rounds; ++round) {
    const auto run = run_virtual(file, folder / fmt::format("{}.db", round), false);
    if (!run) return {failed(job, run.error().what)};
    wall_s.push_back(run->process.wall_s);
    cpu_s.push_back(run->process.cpu_s);
    last = *run;
  }
  const Spread wall = spread_of(wall_s);
  const double hurry = last.campaign_s / wall.median;
  return {within(job, wall, 1.0, described(last)),
          within("the same, CPU", spread_of(cpu_s), 1.0,
                 fmt::format("{:.0f} ns a frame", 1e9 * spread_of(cpu_s).median / last.frames)),
          number("the same: times real time, wall", shown(hurry, "x"), "", {},
                 "process start included"),
          number("the same: memory", shown(last.process.memory_bytes / 1e6, "MB"), "", {}, "")};
}

/// The same setpoints without boards and store: what the deciding alone costs.
Row decisions_row() {
  const campaign::Plan plan = campaign::paper_plan();
  double campaign_s = 0;
  const Spread taken = time_of_call_s([&] {
    campaign::CleanCampaign campaign(plan, rig::ChamberPhysics{});
    campaign.run();
    campaign_s = to_seconds(campaign.length());
  });
  const double hurry = campaign_s / taken.median;
  return number("decisions alone: times real time, CPU", shown(hurry, "x"), ">= 2e6 x",
                hurry >= 2e6, fmt::format("{:.1f} h in {}", campaign_s / 3600, shown_s(taken)));
}

Rows decode_rows(const std::string& recording) {
  std::vector<double> taken;
  double frames = 0;
  for (int round = 0; round < campaign_rounds; ++round) {
    const auto decoded = decode_recording(recording);
    if (!decoded) return {failed("decoding a recording", decoded.error().what)};
    taken.push_back(decoded->cpu_s);
    frames = decoded->frames;
  }
  const Spread spread = spread_of(taken);
  const double rate = frames / spread.median;
  return {within("its recording decoded, CPU", spread, {},
                 fmt::format("{:.0f} frames: read, unpacked, checked", frames)),
          number("the same: frames a second", shown(rate, "/s"), ">= 1e7 /s", rate >= 1e7, "")};
}

Rows replay_rows(const std::string& recording, double frames) {
  std::vector<double> wall_s;
  std::vector<double> cpu_s;
  for (int round = 0; round < campaign_rounds; ++round) {
    const auto replayed = run_child({GYROCAL_PROGRAM, "replay", recording});
    if (!replayed || replayed->exit_code != 0) return {failed("replay", recording)};
    wall_s.push_back(replayed->wall_s);
    cpu_s.push_back(replayed->cpu_s);
  }
  const Spread wall = spread_of(wall_s);
  return {within("gyrocal replay of it, twice at once, wall", wall, {},
                 "links, decisions, every row and model compared"),
          within("the same, CPU", spread_of(cpu_s), {}, ""),
          number("the same: frames a second", shown(2 * frames / wall.median, "/s"), "", {},
                 "both passes; stored and compared")};
}

}  // namespace

Rows campaign_rows() {
  const Scratch folder;
  const std::string file = folder / "campaign.toml";
  const auto written = write_campaign_file(file, {{"soak_s_min = 420", "soak_s_min = 1500"}});
  if (!written) return {failed(job, written.error().what)};
  Rows rows = virtual_rows(file, folder);
  rows.push_back(decisions_row());
  const auto recorded = run_virtual(file, folder / "recorded.db", true);
  if (!recorded) {
    rows.push_back(failed("a recorded campaign", recorded.error().what));
    return rows;
  }
  const std::string recording = folder / "recorded.recording.db";
  append(rows, decode_rows(recording));
  append(rows, replay_rows(recording, recorded->frames));
  return rows;
}

}  // namespace gyrocal::bench
