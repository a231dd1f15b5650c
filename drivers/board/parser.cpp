#include "drivers/board/parser.h"

#include <algorithm>
#include <cstring>
#include <utility>

namespace gyrocal::inemo {
namespace {

constexpr auto data_control = static_cast<std::uint8_t>(Control::data);
constexpr auto trace_control = static_cast<std::uint8_t>(Control::trace);
constexpr auto ack_control = static_cast<std::uint8_t>(Control::ack);
constexpr auto nack_control = static_cast<std::uint8_t>(Control::nack);
constexpr auto data_id = static_cast<std::uint8_t>(Id::start);
constexpr auto trace_id = static_cast<std::uint8_t>(Id::trace);

constexpr int gyro_lsb_max = 4095;  // a difference of two 12-bit conversions
constexpr int temperature_raw_min = -55 * 256;
constexpr int temperature_raw_max = 125 * 256;

}  // namespace

void Parser::reset() {
  mode_.reset();
  streaming_ = false;
  counter_.reset();
  tally_ = {};
  begin_ = end_ = earlier_end_ = 0;
}

void Parser::expect(const OutputMode& mode) {
  mode_ = mode;
  layout_ = layout_of(mode);
  data_quiet_ = 2 * seconds(1.0 / rate_hz(mode.rate_code).value_or(1));
  streaming_ = false;
}

void Parser::feed(std::span<const std::uint8_t> bytes, Instant now, std::vector<Event>& into) {
  if (bytes.empty()) {
    while (parse(now, into) && now - last_arrival_ >= timing_.partial_max) skip_byte();
    return;
  }
  earlier_end_ = end_;
  earlier_arrival_ = last_arrival_;
  last_arrival_ = now;
  while (!bytes.empty()) {
    compact();
    const std::size_t taken = std::min(bytes.size(), buffer_.size() - end_);
    std::memcpy(buffer_.data() + end_, bytes.data(), taken);
    end_ += taken;
    bytes = bytes.subspan(taken);
    parse(now, into);
  }
}

bool Parser::parse(Instant now, std::vector<Event>& into) {
  while (begin_ < end_) {
    const Candidate frame = candidate_at(begin_);
    if (frame.head == Head::no) {
      skip_byte();
      continue;
    }
    if (frame.head == Head::perhaps || end_ - begin_ < frame.frame_bytes) return true;
    const Head next = candidate_at(begin_ + frame.frame_bytes).head;
    if (next == Head::no) {
      skip_byte();
      continue;
    }
    if (next == Head::perhaps && !is_quiet(buffer_[begin_], now)) return false;
    const std::size_t frame_end = begin_ + frame.frame_bytes;
    accept({buffer_.data() + begin_, frame.frame_bytes},
           frame_end <= earlier_end_ ? earlier_arrival_ : last_arrival_, into);
    begin_ = frame_end;
  }
  return false;
}

Parser::Candidate Parser::candidate_at(std::size_t at) const {
  const std::size_t available = end_ - at;
  const std::uint8_t* const head = buffer_.data() + at;
  if (available == 0) return {Head::perhaps, 0};
  const std::uint8_t control = head[0];
  const bool is_data = control == data_control;
  if (!is_data && control != ack_control && control != nack_control && control != trace_control) {
    return {};
  }
  if (available == 1) return {Head::perhaps, 0};
  const std::uint8_t length = head[1];
  const bool length_fits = is_data                    ? is_data_length(length)
                           : control == nack_control  ? length == 2
                           : control == trace_control ? length >= 1 && length <= trace_length_max
                                                      : length >= 1 && length <= ack_length_max;
  if (!length_fits) return {};
  if (available == 2) return {Head::perhaps, 0};
  const std::uint8_t id = head[2];
  const bool id_fits = is_data                    ? id == data_id
                       : control == trace_control ? id == trace_id
                                                  : is_known_id(id);
  if (!id_fits) return {};
  return {Head::yes, std::size_t{length} + 2};
}

bool Parser::is_data_length(std::uint8_t length) const {
  if (mode_) return length == layout_.length;
  return length >= 3 && length <= 53 && length % 2 == 1;  // every mode of a V2
}

bool Parser::is_quiet(std::uint8_t control, Instant now) const {
  const bool is_expected_data = control == data_control && streaming_;
  return now - last_arrival_ >= (is_expected_data ? data_quiet_ : timing_.reply_quiet);
}

bool Parser::is_possible(const DataFrame& frame) const {
  if (!mode_->raw) return true;
  for (const std::int16_t axis : frame.gyro) {
    if (axis < -gyro_lsb_max || axis > gyro_lsb_max) return false;
  }
  return frame.temperature >= temperature_raw_min && frame.temperature <= temperature_raw_max;
}

void Parser::accept(std::span<const std::uint8_t> frame, Instant arrived,
                    std::vector<Event>& into) {
  if (frame[0] == data_control) {
    if (streaming_) accept_data(frame, arrived, into);
  } else if (frame[0] != trace_control) {
    accept_reply(frame, into);
  }
}

void Parser::accept_data(std::span<const std::uint8_t> frame, Instant arrived,
                         std::vector<Event>& into) {
  DataEvent event{decode_data_frame(layout_, frame), 0, false, arrived};
  const bool is_next = counter_.is_next(event.frame.counter);
  if (!is_possible(event.frame)) {
    ++tally_.rejected;
    if (is_next) counter_.advance();  // it came, so its number is not missing
    return;
  }
  if (is_next) {
    event.counter = counter_.advance();
    ++tally_.frames;
    into.emplace_back(event);
    return;
  }
  passed_.clear();
  counter_.take(event, tally_, passed_);
  tally_.frames += passed_.size();
  into.insert(into.end(), passed_.begin(), passed_.end());
}

void Parser::accept_reply(std::span<const std::uint8_t> frame, std::vector<Event>& into) {
  const auto payload = frame.subspan(header_bytes);
  const bool ack = frame[0] == ack_control;
  into.emplace_back(ReplyEvent{ack, frame[2], Bytes(payload.begin(), payload.end())});
  if (ack && frame[2] == data_id && mode_ && !streaming_) {
    streaming_ = true;
    counter_.reset();
    tally_ = {};
  }
}

void Parser::skip_byte() {
  ++begin_;
  ++tally_.bytes_skipped;
}

void Parser::compact() {
  std::memmove(buffer_.data(), buffer_.data() + begin_, end_ - begin_);
  earlier_end_ -= std::min(earlier_end_, begin_);
  end_ -= begin_;
  begin_ = 0;
}

}  // namespace gyrocal::inemo
