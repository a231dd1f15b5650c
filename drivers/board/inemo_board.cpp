#include "drivers/board/inemo_board.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace gyrocal {
namespace {

using inemo::Id;

constexpr int tries_default = 3;
constexpr std::size_t mcu_id_bytes = 12;

inemo::ParserTiming parser_timing(const BoardTiming& timing) {
  return {timing.reply_quiet, timing.partial_frame_max};
}

Result<inemo::OutputMode> output_mode(const BoardMode& wanted) {
  const auto code = inemo::rate_code(wanted.sample_rate_hz);
  if (!code) {
    return fail(Errc::out_of_range, fmt::format("sample rate {} Hz", wanted.sample_rate_hz),
                "the firmware knows 1, 10, 25, 30, 50, 100 and 400 Hz");
  }
  inemo::OutputMode mode;
  mode.raw = true;
  mode.gyro = true;
  mode.accelerometer = wanted.accelerometer;
  mode.temperature = wanted.temperature;
  mode.rate_code = *code;
  return mode;
}

bool is_printable(std::span<const std::uint8_t> text) {
  return std::all_of(text.begin(), text.end(), [](std::uint8_t c) { return c >= 32 && c < 127; });
}

}  // namespace

BoardTiming BoardTiming::for_time_scale(double scale) {
  const auto scaled = [scale](Duration duration) {
    return Duration{std::llround(static_cast<double>(duration.count()) * scale)};
  };
  const BoardTiming real;
  return {scaled(real.reply_timeout), scaled(real.partial_frame_max), scaled(real.reply_quiet)};
}

InemoBoard::InemoBoard(ByteLink& link, Clock& clock, BoardTiming timing)
    : link_(link), clock_(clock), timing_(timing), parser_(parser_timing(timing)) {}

Result<BoardIdentity> InemoBoard::open(const BoardMode& wanted) {
  const auto mode = output_mode(wanted);
  if (!mode) return tl::unexpected(mode.error());
  parser_.reset();
  pending_.clear();
  if (!link_up_) {
    if (const auto opened = link_.reopen(); !opened) return link_failed(opened.error());
    link_up_ = true;
  }
  for (const Id id : {Id::connect, Id::stop}) {
    if (const auto done = command(id); !done) return tl::unexpected(done.error());
  }
  auto identity = identify();
  if (!identity) return identity;
  if (const auto set = set_mode(*mode); !set) return tl::unexpected(set.error());
  return identity;
}

Result<BoardIdentity> InemoBoard::identify() {
  auto firmware = read_text(Id::firmware_version);
  if (!firmware) return tl::unexpected(firmware.error());
  auto hardware = read_text(Id::hardware_version);
  if (!hardware) return tl::unexpected(hardware.error());
  if (!firmware->starts_with("iNEMO") || !hardware->starts_with("iNEMO V2")) {
    return fail(Errc::mismatch,
                fmt::format("is \"{}\" with \"{}\", expected an iNEMO V2", *hardware, *firmware),
                "is this the right port?");
  }
  const auto mcu_id = command(Id::mcu_id);
  if (!mcu_id) return tl::unexpected(mcu_id.error());
  if (mcu_id->size() != mcu_id_bytes) {
    return fail(Errc::mismatch, fmt::format("MCU id of {} bytes, expected 12", mcu_id->size()));
  }
  const Bytes in_order(mcu_id->rbegin(), mcu_id->rend());  // the firmware sends it reversed
  return BoardIdentity{fmt::format("{:02x}", fmt::join(in_order, "")), std::move(*firmware),
                       std::move(*hardware)};
}

Result<std::string> InemoBoard::read_text(Id id) {
  const auto payload = command(id);
  if (!payload) return tl::unexpected(payload.error());
  if (payload->empty() || !is_printable(*payload)) {
    return fail(Errc::mismatch,
                fmt::format("{} answered {:02x}, expected text", inemo::name_of(id),
                            fmt::join(*payload, " ")),
                "is this an iNEMO V2?");
  }
  return std::string(payload->begin(), payload->end());
}

Result<void> InemoBoard::set_mode(const inemo::OutputMode& mode) {
  const auto bytes = inemo::encode_output_mode(mode);
  if (const auto set = command(Id::set_output_mode, bytes); !set) {
    return tl::unexpected(set.error());
  }
  const auto got = command(Id::get_output_mode);
  if (!got) return tl::unexpected(got.error());
  if (!std::equal(got->begin(), got->end(), bytes.begin(), bytes.end())) {
    return fail(Errc::mismatch,
                fmt::format("set output mode {:02x}, read back {:02x}", fmt::join(bytes, " "),
                            fmt::join(*got, " ")),
                "does its firmware differ from 2.2?");
  }
  mode_ = mode;
  parser_.expect(mode);
  return {};
}

Result<void> InemoBoard::start() {
  pending_.clear();
  Result<Bytes> started;
  for (int i = 0; i < tries_default; ++i) {
    parser_.expect(mode_);
    sample_clock_ = inemo::SampleClock(*inemo::rate_hz(mode_.rate_code));
    ticks_missed_before_ = 0;
    started = command(Id::start, {}, 1);
    if (started) return {};
    if (started.error().code != Errc::timeout || !link_up_) break;
    // It may stream although its reply was lost; then nothing but Stop may be sent.
    if (const auto stopped = command(Id::stop, {}, 1); !stopped && !link_up_) {
      return tl::unexpected(stopped.error());
    }
  }
  return tl::unexpected(started.error());
}

Result<void> InemoBoard::stop() {
  if (const auto stopped = command(Id::stop); !stopped) return tl::unexpected(stopped.error());
  parser_.expect(mode_);
  return {};
}

Result<void> InemoBoard::drain(std::vector<BoardSample>& into) {
  auto received = receive();
  into.insert(into.end(), pending_.begin(), pending_.end());
  pending_.clear();
  replies_.clear();
  return received;
}

Result<Bytes> InemoBoard::command(Id id, std::span<const std::uint8_t> payload, int tries) {
  const Bytes frame = inemo::encode_command(id, payload);
  for (int i = 0; i < tries; ++i) {
    replies_.clear();
    if (!link_up_) {
      return fail(Errc::link_lost, fmt::format("{}: the link is closed", inemo::name_of(id)),
                  "open the board again");
    }
    if (const auto written = link_.write(frame); !written) return link_failed(written.error());
    auto reply = await_reply(id);
    if (!reply) return tl::unexpected(reply.error());
    if (!*reply) continue;
    if ((*reply)->ack) return std::move((*reply)->payload);
    return fail(Errc::refused, fmt::format("{} was refused: {}", inemo::name_of(id),
                                           inemo::name_of_nack((*reply)->payload.front())));
  }
  return fail(Errc::timeout,
              fmt::format("{}: no reply, {} x {} s", inemo::name_of(id), tries,
                          to_seconds(timing_.reply_timeout)),
              "is this an iNEMO V2, and does nothing else use its port?");
}

Result<std::optional<inemo::ReplyEvent>> InemoBoard::await_reply(Id id) {
  const Instant deadline = clock_.now() + timing_.reply_timeout;
  const Duration poll_interval = timing_.reply_timeout / 100;
  for (;;) {
    if (const auto received = receive(); !received) return tl::unexpected(received.error());
    const auto found = std::find_if(replies_.begin(), replies_.end(), [id](const auto& reply) {
      return reply.id == static_cast<std::uint8_t>(id);
    });
    if (found != replies_.end()) return std::move(*found);
    const Instant now = clock_.now();
    if (now >= deadline) return std::nullopt;
    clock_.sleep_until(std::min(now + poll_interval, deadline));
  }
}

Result<void> InemoBoard::receive() {
  if (!link_up_) return fail(Errc::link_lost, "the link is closed", "open the board again");
  std::array<std::uint8_t, 4096> chunk;
  for (;;) {
    const auto count = link_.read(chunk);
    if (!count) return link_failed(count.error());
    parser_.feed(std::span(chunk).first(*count), clock_.now(), events_);
    sort_events();
    if (*count == 0) return {};
  }
}

void InemoBoard::sort_events() {
  std::size_t first = pending_.size();
  Instant read_at{};
  for (const inemo::Event& event : events_) {
    if (const auto* reply = std::get_if<inemo::ReplyEvent>(&event)) {
      replies_.push_back(*reply);
      continue;
    }
    const auto& data = std::get<inemo::DataEvent>(event);
    if (data.restarted || data.arrived != read_at) {
      stamp(first);
      first = pending_.size();
      read_at = data.arrived;
    }
    if (data.restarted) {
      ticks_missed_before_ += sample_clock_.ticks_missed();
      sample_clock_ = inemo::SampleClock(*inemo::rate_hz(mode_.rate_code));
    }
    BoardSample sample{read_at.time_since_epoch().count(), data.counter, data.frame.gyro, {}};
    if (mode_.temperature) sample.temperature_raw = data.frame.temperature;
    pending_.push_back(sample);
  }
  stamp(first);
  events_.clear();
  tally_ = parser_.tally();
  tally_.ticks_missed = ticks_missed_before_ + sample_clock_.ticks_missed();
}

// The samples from `first` on came with one read and carry its time; gives them their own.
void InemoBoard::stamp(std::size_t first) {
  if (first == pending_.size()) return;
  const Instant read_at{Duration{pending_.back().t_ns}};
  sample_clock_.observe(pending_.back().counter, read_at);
  for (std::size_t i = first; i < pending_.size(); ++i) {
    BoardSample& sample = pending_[i];
    const Instant taken = std::min(sample_clock_.time_of(sample.counter), read_at);
    last_t_ns_ = std::max(last_t_ns_ + 1, taken.time_since_epoch().count());
    sample.t_ns = last_t_ns_;
  }
}

tl::unexpected<Error> InemoBoard::link_failed(const Error& failure) {
  link_up_ = false;
  return tl::unexpected(failure);
}

}  // namespace gyrocal
