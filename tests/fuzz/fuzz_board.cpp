/// The board's parser with mutated streams: it must neither fail nor hang nor loop, whatever comes
/// and however it is cut, and each data frame it passes must keep the promises of parser.h.

#include "compensation/values/assert.h"
#include "tests/drivers/board/streams.h"
#include "tests/fuzz/loop.h"

using namespace gyrocal;
using namespace gyrocal::inemo;

namespace {

std::vector<OutputMode> modes() {
  OutputMode with_ahrs = test::raw_mode(true, true);
  with_ahrs.ahrs = true;
  OutputMode calibrated = test::raw_mode(true);
  calibrated.raw = false;
  return {test::raw_mode(false), test::raw_mode(true), test::raw_mode(true, true), with_ahrs,
          calibrated};
}

std::vector<fuzz::Bytes> seeds() {
  std::mt19937 random(1);
  const Bytes text(26, 'v');
  const Bytes replies[] = {encode_ack(Id::connect), encode_ack(Id::stop), encode_ack(Id::start),
                           encode_ack(Id::firmware_version, text),
                           encode_nack(0x50, Nack::out_of_range)};
  std::vector<fuzz::Bytes> all{{}, {'A', 'T', '+', 'G', 'C', 'A', 'P', '\r'}};
  all.emplace_back(300, std::uint8_t{0x40});
  all.emplace_back(300, std::uint8_t{0x80});
  all.emplace_back(300, std::uint8_t{0xC0});
  for (const OutputMode& mode : modes()) {
    Bytes stream = encode_ack(Id::start);
    for (const std::uint16_t first : {std::uint16_t{1}, std::uint16_t{65530}}) {
      const auto frames = test::random_frames(12, first, mode, random);
      const Bytes bytes = test::bytes_of(frames, mode);
      stream.insert(stream.end(), bytes.begin(), bytes.end());
      for (const Bytes& reply : replies) stream.insert(stream.end(), reply.begin(), reply.end());
    }
    all.push_back(std::move(stream));
  }
  return all;
}

void check_events(const std::vector<Event>& events, const OutputMode& mode) {
  std::uint32_t last = 0;
  for (const Event& event : events) {
    if (const auto* reply = std::get_if<ReplyEvent>(&event)) {
      GYROCAL_ASSERT(is_known_id(reply->id));
      GYROCAL_ASSERT(reply->ack ? reply->payload.size() < ack_length_max
                                : reply->payload.size() == 1);
      if (reply->ack && reply->id == static_cast<std::uint8_t>(Id::start)) last = 0;
      continue;
    }
    const auto& data = std::get<DataEvent>(event);
    GYROCAL_ASSERT(data.counter > last);
    last = data.counter;
    if (!mode.raw) continue;
    for (const int axis : data.frame.gyro) GYROCAL_ASSERT(axis >= -4095 && axis <= 4095);
    const int temperature = data.frame.temperature;
    GYROCAL_ASSERT(temperature >= -55 * 256 && temperature <= 125 * 256);
  }
}

void check(const fuzz::Bytes& bytes, std::mt19937_64& random) {
  static const auto all_modes = modes();
  const OutputMode& mode = all_modes[random() % all_modes.size()];
  Parser parser;
  const bool mode_known = random() % 8 != 0;
  if (mode_known) parser.expect(mode);
  std::vector<Event> events;
  Instant now{};
  std::span<const std::uint8_t> rest(bytes);
  while (!rest.empty()) {
    const std::size_t count = std::min<std::size_t>(rest.size(), random() % 64);
    now += seconds(static_cast<double>(random() % 50) * 1e-3);
    parser.feed(rest.first(count), now, events);
    rest = rest.subspan(count);
  }
  for (int i = 0; i < 2000; ++i) {
    now += seconds(1.1);
    parser.feed({}, now, events);
  }
  check_events(events, mode);
  if (!mode_known) GYROCAL_ASSERT(test::frames_in(events).empty());
  GYROCAL_ASSERT(parser.tally().bytes_skipped <= bytes.size());

  // Whatever came before, a clean stream is found again.
  parser.expect(mode);
  events.clear();
  std::mt19937 frame_random(7);
  parser.feed(encode_ack(Id::start), now, events);
  now += seconds(3);
  parser.feed({}, now, events);
  parser.feed(test::bytes_of(test::random_frames(5, 1, mode, frame_random), mode), now, events);
  now += seconds(3);
  parser.feed({}, now, events);
  GYROCAL_ASSERT(test::frames_in(events).size() == 5);
}

}  // namespace

int main(int argc, char** argv) { return fuzz::run(argc, argv, seeds(), check); }
