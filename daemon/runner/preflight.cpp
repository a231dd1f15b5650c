#include "daemon/runner/preflight.h"

#include <fmt/core.h>

#include <cmath>

namespace gyrocal::runner {
namespace {

Error about(const std::string& device, Error error) {
  error.what = device + ": " + error.what;
  return error;
}

Result<void> first_frame(Board& board, Clock& clock, Duration patience) {
  std::vector<BoardSample> seen;
  const Instant deadline = clock.now() + patience;
  for (;;) {
    if (auto drained = board.drain(seen); !drained) return drained;
    if (!seen.empty()) return {};
    const Instant now = clock.now();
    if (now >= deadline) break;
    clock.sleep_until(now + patience / 50);
  }
  return fail(Errc::timeout,
              fmt::format("it accepted Start and sent no frame in {:.0f} s", to_seconds(patience)),
              "reset the board or plug it in again; is another program reading the port?");
}

}  // namespace

Result<ChamberReading> inspect_chamber(const CampaignConfig& config, Chamber& chamber) {
  auto reading = chamber.read();
  if (!reading) return reading;
  const auto& profile = config.chamber.profile;
  const auto possible = [&](Celsius t) {
    return std::isfinite(t.value) && t >= profile.limit_min - Kelvin{20} &&
           t <= profile.limit_max + Kelvin{20};
  };
  if (!possible(reading->actual)) {
    return fail(Errc::mismatch,
                fmt::format("chamber: it reads {} degC, where the profile '{}' goes from {:.0f} to "
                            "{:.0f} degC",
                            reading->actual.value, profile.name, profile.limit_min.value,
                            profile.limit_max.value),
                "is it the right profile (registers, word order, scale) for this chamber?");
  }
  if (reading->constant_mode == false) {
    return fail(Errc::busy, "chamber: a program of its own is running",
                "stop the program at the panel and switch to constant temperature; a setpoint "
                "written now would be ignored or spoil it");
  }
  return reading;
}

Result<BoardIdentity> inspect_board(const BoardConfig& config, Board& board, const BoardMode& mode,
                                    Clock& clock, Duration patience) {
  const std::string who = fmt::format("board '{}' at {}", config.name, config.device);
  auto identity = board.open(mode);
  if (!identity) return tl::unexpected(about(who, identity.error()));
  if (config.mcu_id && *config.mcu_id != identity->mcu_id) {
    return fail(Errc::mismatch,
                fmt::format("{}: its MCU id is {}, the campaign file expects {}", who,
                            identity->mcu_id, *config.mcu_id),
                "plug in that board, or correct mcu_id in the campaign file");
  }
  auto streaming = board.start();
  if (streaming) streaming = first_frame(board, clock, patience);
  if (!streaming) return tl::unexpected(about(who, streaming.error()));
  return identity;
}

namespace {

/// Whether a board is merely away, and who it was.
std::optional<BoardIdentity> known_and_away(const std::string& name, const Error& error,
                                            std::span<const std::pair<BoardId, BoardRow>> before) {
  const bool away = error.code == Errc::timeout || error.code == Errc::link_lost ||
                    error.code == Errc::bad_frame || error.code == Errc::refused;
  for (const auto& [id, row] : before) {
    if (away && row.name == name) {
      return BoardIdentity{row.mcu_id, row.firmware_version, row.hardware_version};
    }
  }
  return std::nullopt;
}

}  // namespace

Result<Found> preflight(const CampaignConfig& config, Devices& devices, Duration patience,
                        std::span<const std::pair<BoardId, BoardRow>> before) {
  auto chamber = inspect_chamber(config, devices.chamber);
  if (!chamber) return tl::unexpected(chamber.error());
  Found found{*chamber, {}, {}};
  const BoardMode mode{config.plan.sample_rate_hz, false, true};
  for (std::size_t i = 0; i < config.boards.size(); ++i) {
    auto identity =
        inspect_board(config.boards[i], *devices.boards[i], mode, devices.clock, patience);
    found.away.emplace_back();
    if (!identity) {
      const auto known = known_and_away(config.boards[i].name, identity.error(), before);
      if (!known) return tl::unexpected(identity.error());
      found.away.back() = identity.error();
      identity = *known;
    }
    for (std::size_t other = 0; other < i; ++other) {
      if (found.boards[other].mcu_id != identity->mcu_id) continue;
      return fail(Errc::mismatch,
                  fmt::format("boards '{}' and '{}' are the same board, MCU id {}",
                              config.boards[other].name, config.boards[i].name, identity->mcu_id),
                  "give each its own device in the campaign file");
    }
    found.boards.push_back(*identity);
  }
  return found;
}

}  // namespace gyrocal::runner
