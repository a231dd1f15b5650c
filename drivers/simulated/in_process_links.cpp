#include "drivers/simulated/in_process_links.h"

#include <fmt/format.h>

#include <algorithm>

namespace gyrocal {

InProcessBoardLink::InProcessBoardLink(SimulatedBoard& board, Clock& clock)
    : board_(board), clock_(clock), appearance_(board.appearance()) {}

Result<void> InProcessBoardLink::still_there() {
  board_.advance(clock_.now());
  if (board_.present() && board_.appearance() == appearance_) return {};
  return fail(Errc::link_lost, "simulated board: unplugged", "plug it in, then open it again");
}

Result<std::size_t> InProcessBoardLink::read(std::span<std::uint8_t> into) {
  if (const auto there = still_there(); !there) return tl::unexpected(there.error());
  const auto waiting = board_.output();
  const std::size_t count = std::min(waiting.size(), into.size());
  std::copy_n(waiting.begin(), count, into.begin());
  board_.take(count);
  return count;
}

Result<void> InProcessBoardLink::write(std::span<const std::uint8_t> bytes) {
  if (auto there = still_there(); !there) return there;
  board_.receive(bytes, clock_.now());
  return {};
}

Result<void> InProcessBoardLink::reopen() {
  board_.advance(clock_.now());
  if (!board_.present()) return fail(Errc::link_lost, "simulated board: not there");
  appearance_ = board_.appearance();
  board_.host_closes(clock_.now());
  board_.host_opens(clock_.now());
  return {};
}

Result<Bytes> InProcessChamberLink::transact(std::span<const std::uint8_t> request) {
  using Way = ChamberAnswer::Way;
  auto answer = chamber_.exchange(request, clock_.now());
  if (answer.way == Way::hang_up) {
    return fail(Errc::link_lost, "simulated chamber: connection refused", "is it switched on?");
  }
  const bool arrives = answer.way == Way::whole || answer.way == Way::twice;
  if (arrives && answer.delay < reply_timeout_) {
    clock_.sleep_until(clock_.now() + answer.delay);
    return std::move(answer.reply);
  }
  clock_.sleep_until(clock_.now() + reply_timeout_);
  return fail(Errc::timeout,
              fmt::format("simulated chamber: no reply in {} s", to_seconds(reply_timeout_)),
              "is the unit id right, and the chamber alive?");
}

}  // namespace gyrocal
