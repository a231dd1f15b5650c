#include "daemon/runner/board_port.h"

#include <fmt/core.h>

namespace gyrocal::runner {
namespace {

constexpr BoardMode slow_mode{1, false, true};  ///< the sensor converts in 150 ms
constexpr Duration slow_frame_within = std::chrono::seconds{4};

}  // namespace

BoardPort::BoardPort(Board& board, BoardIdentity identity, BoardMode mode, Duration stale_after,
                     Duration t)
    : board_(board),
      mode_(mode),
      stale_after_(stale_after),
      back_off_(std::chrono::seconds{1}, std::chrono::seconds{30}),
      identity_(std::move(identity)),
      last_frame_(t) {}

void BoardPort::poll(Duration t, std::vector<BoardSample>& into) {
  if (!present_) return try_again(t);
  const std::size_t before = into.size();
  if (auto drained = board_.drain(into); !drained) return lost(t, to_text(drained.error()));
  if (into.size() > before) {
    last_frame_ = t;
  } else if (t - last_frame_ > stale_after_) {
    lost(t, fmt::format("no frame for {:.0f} s", to_seconds(t - last_frame_)));
  }
}

void BoardPort::stop() {
  if (present_) static_cast<void>(board_.stop());  // going away anyway; the next start stops it too
  present_ = false;
}

void BoardPort::lost(Duration t, const std::string& why) {
  present_ = false;
  away_since_ = t;
  trouble_ = why;
}

void BoardPort::try_again(Duration t) {
  if (!back_off_.due(t)) return;
  auto identity = board_.open(mode_);
  if (identity && identity->mcu_id != identity_.mcu_id) {
    trouble_ = fmt::format("another board answers there: MCU id {}, expected {}", identity->mcu_id,
                           identity_.mcu_id);
    return back_off_.failed(t);
  }
  if (!identity || !board_.start()) return back_off_.failed(t);  // the outage is on record
  back_off_.succeeded();
  present_ = true;
  away_since_.reset();
  last_frame_ = t;
}

Result<void> BoardPort::stream(const BoardMode& mode) {
  if (auto identity = board_.open(mode); !identity) return tl::unexpected(identity.error());
  return board_.start();
}

Result<Celsius> BoardPort::first_temperature(Clock& clock) {
  std::vector<BoardSample> samples;
  const Instant deadline = clock.now() + slow_frame_within;
  while (clock.now() < deadline) {
    if (auto drained = board_.drain(samples); !drained) return tl::unexpected(drained.error());
    for (const BoardSample& sample : samples) {
      if (sample.temperature_raw) return Celsius{*sample.temperature_raw / 256.0};
    }
    clock.sleep_until(clock.now() + slow_frame_within / 20);
  }
  return fail(Errc::timeout, "no frame at 1 Hz");
}

std::optional<Celsius> BoardPort::read_temperature(Duration t, Clock& clock) {
  if (!present_) return std::nullopt;
  mode_.temperature = false;
  auto slow = stream(slow_mode);
  auto read = slow ? first_temperature(clock) : tl::unexpected(slow.error());
  const auto fast = stream(mode_);
  last_frame_ = t + 2 * slow_frame_within;
  if (fast && read) return *read;
  lost(t, to_text(fast ? read.error() : fast.error()));
  return std::nullopt;
}

}  // namespace gyrocal::runner
