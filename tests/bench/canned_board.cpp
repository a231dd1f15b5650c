#include "tests/bench/canned_board.h"

#include <algorithm>
#include <random>

#include "drivers/board/frame.h"

namespace gyrocal::bench {

void CannedLink::play(std::span<const std::uint8_t> bytes, std::size_t bytes_a_read) {
  bytes_ = bytes;
  bytes_a_read_ = bytes_a_read;
  playing_ = true;
}

Result<std::size_t> CannedLink::read(std::span<std::uint8_t> into) {
  if (!playing_) return board_.read(into);
  gave_ = !gave_;
  if (!gave_) return std::size_t{0};
  const std::size_t count = std::min({bytes_.size(), bytes_a_read_, into.size()});
  std::copy_n(bytes_.begin(), count, into.begin());
  bytes_ = bytes_.subspan(count);
  return count;
}

Result<void> CannedLink::write(std::span<const std::uint8_t> bytes) { return board_.write(bytes); }

CannedBoard::CannedBoard(const BoardMode& mode)
    : rig_({}, 1, 1, ChamberProfile{}, 1),
      simulated_(rig_.board(0), clock_),
      link_(simulated_),
      board_(link_, clock_) {
  const auto opened = board_.open(mode);
  started_ = opened ? board_.start() : tl::unexpected(opened.error());
}

Bytes frames_on_wire(const BoardMode& mode, std::size_t frames) {
  inemo::OutputMode output;
  output.raw = true;
  output.gyro = true;
  output.temperature = mode.temperature;
  const inemo::DataLayout layout = inemo::layout_of(output);
  std::mt19937 random(5);
  std::normal_distribution<double> lsb(17, 5);
  Bytes bytes;
  bytes.reserve(frames * layout.frame_bytes);
  for (std::size_t i = 0; i < frames; ++i) {
    inemo::DataFrame frame;
    frame.counter = static_cast<std::uint16_t>(i + 1);
    for (std::int16_t& axis : frame.gyro) axis = static_cast<std::int16_t>(lsb(random));
    frame.temperature = 5120;
    inemo::encode_data_frame(layout, frame, bytes);
  }
  return bytes;
}

}  // namespace gyrocal::bench
