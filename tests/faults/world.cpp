#include "tests/faults/world.h"

#include <algorithm>
#include <utility>

namespace gyrocal::faults {
namespace {

constexpr std::int64_t utc_start_ns = 1'767'225'600'000'000'000;  // 2026-01-01T00:00:00Z
constexpr Instant end_of_patience{std::chrono::hours{120}};

}  // namespace

void World::sleep_until(Instant when) {
  while (!deeds_.empty() && deeds_.begin()->first <= when) {
    const auto deed = deeds_.extract(deeds_.begin());
    now_ = std::max(now_, deed.key());
    deed.mapped()();
  }
  now_ = std::max(now_, when);
  if (now_ > end_of_patience) throw Hung{};
}

std::int64_t World::utc_ns() const { return utc_start_ns + now_.time_since_epoch().count(); }

void Host::sleep_until(Instant when) {
  step();
  while (now() < when) world_.sleep_until(when + slept_);
}

void Host::sleep_machine(Duration how_long) {
  const Instant before = world_.now();
  world_.sleep_until(before + how_long);
  slept_ += world_.now() - before;
}

void Host::step() {
  if (!calls_left_) return;
  if (--*calls_left_ > 0) return;
  calls_left_.reset();
  throw Crashed{};
}

Result<Bytes> WatchedRequestLink::transact(std::span<const std::uint8_t> request) {
  host_.step();
  const auto decoded = modbus::decode_request(request);
  if (decoded && modbus::is_write(*decoded)) on_write_(*decoded);
  return target_.transact(request);
}

Result<std::size_t> WatchedByteLink::read(std::span<std::uint8_t> into) {
  host_.step();
  return target_.read(into);
}

Result<void> WatchedByteLink::write(std::span<const std::uint8_t> bytes) {
  host_.step();
  return target_.write(bytes);
}

Result<void> WatchedByteLink::reopen() {
  host_.step();
  return target_.reopen();
}

Drivers::Drivers(const CampaignConfig& config, SimulatedRig& rig, World& world, Host& host,
                 WatchedRequestLink::OnWrite on_write)
    : wire_(rig.chamber(), world, seconds(config.chamber.reply_timeout_s)),
      link_(wire_, host, std::move(on_write)),
      chamber_(link_, host, config.chamber.profile, config.chamber.unit) {
  for (std::size_t i = 0; i < config.boards.size(); ++i) {
    board_links_.emplace_back(rig.board(i), world, host);
    boards_.emplace_back(board_links_.back(), host);
  }
}

std::vector<Board*> Drivers::boards() {
  std::vector<Board*> all;
  for (auto& board : boards_) all.push_back(&board);
  return all;
}

}  // namespace gyrocal::faults
