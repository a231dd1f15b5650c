#include "daemon/runner/board_port.h"

#include <fmt/core.h>

namespace gyrocal::runner {

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

}  // namespace gyrocal::runner
