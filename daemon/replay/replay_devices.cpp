#include "daemon/replay/replay_devices.h"

#include <fmt/core.h>

#include <algorithm>

#include "daemon/replay/request_text.h"
#include "daemon/runner/link_layers.h"

namespace gyrocal::replay {
namespace {

/// 1-based; 0 if that link was not recorded.
std::uint32_t stream_of(const RecordedRun& run, const std::string& link) {
  const auto found = std::find(run.streams.begin(), run.streams.end(), link);
  return found == run.streams.end() ? 0
                                    : static_cast<std::uint32_t>(found - run.streams.begin() + 1);
}

}  // namespace

Result<std::unique_ptr<ReplayDevices>> ReplayDevices::open(const std::string& recording,
                                                           const RecordedRun& run,
                                                           const CampaignConfig& config,
                                                           const runner::Circumstances& begun) {
  for (const std::string& link : runner::link_names(config)) {
    if (stream_of(run, link) != 0) continue;
    return fail(Errc::mismatch,
                fmt::format("{}: run {} has no bytes of the {}", recording, run.id, link),
                "replay it with a campaign file of the same boards");
  }
  auto reader = RecordingReader::open(recording, run.id);
  if (!reader) return tl::unexpected(reader.error());
  return std::unique_ptr<ReplayDevices>(new ReplayDevices(std::move(*reader), run, config, begun));
}

ReplayDevices::ReplayDevices(RecordingReader reader, const RecordedRun& run,
                             const CampaignConfig& config, const runner::Circumstances& begun)
    : tape_(std::move(reader), run),
      clock_(tape_),
      chamber_link_(tape_, stream_of(run, runner::link_names(config).front())),
      chamber_(chamber_link_, clock_, config.chamber.profile, config.chamber.unit) {
  tape_.explain_requests([profile = config.chamber.profile](std::span<const std::uint8_t> bytes) {
    return request_text(profile, bytes);
  });
  const BoardTiming timing =
      begun.in_virtual_time ? BoardTiming{} : BoardTiming::for_time_scale(config.time_scale);
  const auto names = runner::link_names(config);
  for (std::size_t i = 0; i < config.boards.size(); ++i) {
    board_links_.emplace_back(tape_, stream_of(run, names[i + 1]));
    boards_.emplace_back(board_links_.back(), clock_, timing);
  }
}

runner::Devices ReplayDevices::devices() {
  std::vector<Board*> boards;
  for (auto& board : boards_) boards.push_back(&board);
  return {clock_, chamber_, std::move(boards)};
}

}  // namespace gyrocal::replay
