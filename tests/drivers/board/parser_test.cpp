#include "drivers/board/parser.h"

#include <catch2/catch.hpp>

#include "tests/drivers/board/streams.h"

using namespace gyrocal;
using namespace gyrocal::inemo;
using namespace gyrocal::inemo::test;

namespace {
const OutputMode mode = raw_mode();

std::vector<DataFrame> some_frames(int count, std::uint16_t first = 1) {
  std::mt19937 random(7);
  return random_frames(count, first, mode, random);
}
}  // namespace

TEST_CASE("a stream comes out as it went in, at once but for its last frame", "[parser]") {
  Streaming board(mode);
  const auto frames = some_frames(100);
  board.feed(bytes_of(frames, mode));
  CHECK(frames_in(board.events).size() == 99);
  board.wait(0.039);
  CHECK(frames_in(board.events).size() == 99);
  board.wait(0.002);
  CHECK(frames_in(board.events) == frames);
  CHECK(board.parser.tally().frames == 100);
  CHECK(board.parser.tally().bytes_skipped == 0);
}

TEST_CASE("nothing in, nothing out", "[parser]") {
  Parser parser;
  std::vector<Event> events;
  parser.feed({}, Instant{}, events);
  parser.feed({}, Instant{seconds(5)}, events);
  CHECK(events.empty());
}

TEST_CASE("wherever a read ends, the frames are the same", "[parser]") {
  const auto frames = some_frames(3);
  const Bytes bytes = bytes_of(frames, mode);
  for (std::size_t split = 0; split <= bytes.size(); ++split) {
    CAPTURE(split);
    Streaming board(mode);
    board.feed(std::span(bytes).first(split));
    board.now += seconds(0.02);
    board.feed(std::span(bytes).subspan(split));
    board.wait(0.05);
    CHECK(frames_in(board.events) == frames);
  }
}

TEST_CASE("a stream that drips byte by byte is a stream", "[parser]") {
  const auto frames = some_frames(50);
  Streaming board(mode);
  for (const std::uint8_t byte : bytes_of(frames, mode)) board.feed({&byte, 1});
  board.wait(0.05);
  CHECK(frames_in(board.events) == frames);
}

TEST_CASE("a read larger than the buffer loses nothing", "[parser]") {
  const auto frames = some_frames(5000);
  Streaming board(mode);
  board.feed(bytes_of(frames, mode));
  board.wait(0.05);
  CHECK(frames_in(board.events) == frames);
}

TEST_CASE("joining in the middle of a frame costs that frame only", "[parser]") {
  const auto frames = some_frames(10);
  const Bytes bytes = bytes_of(frames, mode);
  for (std::size_t cut = 1; cut < 13; ++cut) {
    CAPTURE(cut);
    Streaming board(mode);
    board.feed(std::span(bytes).subspan(cut));
    board.wait(0.05);
    CHECK(frames_in(board.events) == std::vector(frames.begin() + 1, frames.end()));
    CHECK(board.parser.tally().missing == 1);
    CHECK(board.parser.tally().bytes_skipped == 13 - cut);
  }
}

TEST_CASE("every frame carries the time at which its last byte was read", "[parser]") {
  const Bytes bytes = bytes_of(some_frames(3), mode);
  Streaming board(mode);
  const Instant start = board.now;
  board.feed(std::span(bytes).first(13));
  board.now = start + seconds(0.02);
  board.feed(std::span(bytes).subspan(13, 20));
  board.now = start + seconds(0.04);
  board.feed(std::span(bytes).subspan(33));
  board.wait(0.05);
  REQUIRE(board.events.size() == 3);
  CHECK(std::get<DataEvent>(board.events[0]).arrived == start);
  CHECK(std::get<DataEvent>(board.events[1]).arrived == start + seconds(0.02));
  CHECK(std::get<DataEvent>(board.events[2]).arrived == start + seconds(0.04));
}

TEST_CASE("the counter wraps from 65535 to 0 and the count goes on", "[parser]") {
  const auto frames = some_frames(65540);
  Streaming board(mode);
  board.feed(bytes_of(frames, mode));
  board.wait(0.05);
  REQUIRE(board.events.size() == 65540);
  const auto& last = std::get<DataEvent>(board.events.back());
  CHECK(last.frame.counter == 4);
  CHECK(last.counter == 65540);
  CHECK(board.parser.tally().missing == 0);
}

TEST_CASE("a doubled frame is dropped, a missing one counted", "[parser]") {
  auto frames = some_frames(10);
  frames.insert(frames.begin() + 4, frames[3]);
  frames.erase(frames.begin() + 7);
  Streaming board(mode);
  board.feed(bytes_of(frames, mode));
  board.wait(0.05);
  CHECK(frames_in(board.events).size() == 9);
  CHECK(board.parser.tally().duplicates == 1);
  CHECK(board.parser.tally().missing == 1);
  CHECK(std::get<DataEvent>(board.events.back()).counter == 10);
}

TEST_CASE("frames out of order do not run time backwards", "[parser]") {
  auto frames = some_frames(10);
  std::swap(frames[4], frames[5]);
  Streaming board(mode);
  board.feed(bytes_of(frames, mode));
  board.wait(0.05);
  std::uint32_t last = 0;
  for (const auto& event : board.events) {
    CHECK(std::get<DataEvent>(event).counter > last);
    last = std::get<DataEvent>(event).counter;
  }
  CHECK(last == 10);
}

TEST_CASE("a gap of 2000 frames is a gap, a longer one a restart", "[parser]") {
  for (const int lost : {1, 1999, 2000, 65535}) {
    CAPTURE(lost);
    auto frames = some_frames(5);
    const auto later = some_frames(5, static_cast<std::uint16_t>(6 + lost));
    frames.insert(frames.end(), later.begin(), later.end());
    Streaming board(mode);
    board.feed(bytes_of(frames, mode));
    board.wait(0.05);
    const BoardTally& tally = board.parser.tally();
    const bool is_gap = lost < 2000;
    const bool looks_doubled = lost == 65535;  // the same number again: one is dropped
    CHECK(tally.missing == (is_gap ? static_cast<unsigned>(lost) : 0));
    CHECK(tally.restarts == (is_gap || looks_doubled ? 0 : 1));
    CHECK(tally.duplicates == (looks_doubled ? 1 : 0));
    CHECK(frames_in(board.events).size() == (looks_doubled ? 9 : 10));
  }
}

TEST_CASE("a board that starts again at 1 is a restart that says so", "[parser]") {
  const auto before = some_frames(100);
  const auto after = some_frames(100);
  Streaming board(mode);
  board.feed(bytes_of(before, mode) + bytes_of(after, mode));
  board.wait(0.05);
  REQUIRE(board.events.size() == 200);
  CHECK(std::get<DataEvent>(board.events[100]).restarted);
  CHECK(std::get<DataEvent>(board.events[100]).counter == 101);
  CHECK_FALSE(std::get<DataEvent>(board.events[101]).restarted);
  CHECK(board.parser.tally().restarts == 1);
}

TEST_CASE("one false counter costs one frame and no restart", "[parser]") {
  for (const int wrong : {0x8006, 0x0106, 7, 9, 0}) {
    CAPTURE(wrong);
    auto frames = some_frames(10);
    frames[5].counter = static_cast<std::uint16_t>(wrong);
    Streaming board(mode);
    board.feed(bytes_of(frames, mode));
    board.wait(0.05);
    frames.erase(frames.begin() + 5);
    CHECK(frames_in(board.events) == frames);
    CHECK(board.parser.tally().restarts == 0);
    CHECK(std::get<DataEvent>(board.events.back()).counter == 10);
  }
}

TEST_CASE("values no sensor can have are rejected, the rest stays", "[parser]") {
  const auto rejects = [](const DataFrame& frame) {
    auto frames = some_frames(3);
    frames[1].gyro = frame.gyro;
    frames[1].temperature = frame.temperature;
    Streaming board(mode);
    board.feed(bytes_of(frames, mode));
    board.wait(0.05);
    CHECK(board.parser.tally().missing == 0);
    CHECK(board.parser.tally().rejected == 3 - frames_in(board.events).size());
    return board.parser.tally().rejected == 1;
  };
  CHECK(rejects({0, {}, {-32768, 0, 0}, {}, 0, 0, {}}));
  CHECK(rejects({0, {}, {0, 4096, 0}, {}, 0, 0, {}}));
  CHECK(rejects({0, {}, {0, 0, -4096}, {}, 0, 0, {}}));
  CHECK(rejects({0, {}, {}, {}, 0, 125 * 256 + 1, {}}));
  CHECK(rejects({0, {}, {}, {}, 0, -55 * 256 - 1, {}}));
  CHECK_FALSE(rejects({0, {}, {-4095, 4095, 0}, {}, 0, 125 * 256, {}}));
  CHECK_FALSE(rejects({0, {}, {}, {}, 0, -55 * 256, {}}));
}

TEST_CASE("the beginning of a frame that never ends is given up after a second", "[parser]") {
  const auto frames = some_frames(2);
  const Bytes bytes = bytes_of(frames, mode);
  Streaming board(mode);
  board.feed(std::span(bytes).first(7));
  board.wait(0.99);
  CHECK(board.parser.tally().bytes_skipped == 0);
  board.wait(0.02);
  CHECK(board.parser.tally().bytes_skipped == 7);
}

TEST_CASE("data before Start's acknowledgement is stale", "[parser]") {
  Parser parser;
  parser.expect(mode);
  std::vector<Event> events;
  const auto stale = some_frames(1, 5000);
  const auto fresh = some_frames(5);
  parser.feed(bytes_of(stale, mode) + encode_ack(Id::start) + bytes_of(fresh, mode), Instant{},
              events);
  parser.feed({}, Instant{seconds(0.05)}, events);
  CHECK(frames_in(events) == fresh);
  CHECK(parser.tally().restarts == 0);
}

TEST_CASE("Stop's acknowledgement is found behind a stream of unknown mode", "[parser]") {
  std::mt19937 random(3);
  for (const OutputMode& unknown : {raw_mode(false), raw_mode(true), raw_mode(true, true)}) {
    Parser parser;
    std::vector<Event> events;
    const Bytes running = bytes_of(random_frames(40, 900, unknown, random), unknown);
    const Bytes joined(running.begin() + 5, running.end());
    parser.feed(joined + encode_ack(Id::stop), Instant{}, events);
    CHECK(events.empty());
    parser.feed({}, Instant{seconds(0.01)}, events);
    CHECK(events == std::vector<Event>{ReplyEvent{true, 0x53, {}}});
  }
}

TEST_CASE("replies between data frames are found and cost none", "[parser]") {
  const auto frames = some_frames(6);
  const Bytes bytes = bytes_of(frames, mode);
  const Bytes nack{0xC0, 0x02, 0x52, 0x03};
  Streaming board(mode);
  board.feed(Bytes(bytes.begin(), bytes.begin() + 39) + encode_ack(Id::stop) + nack +
             Bytes(bytes.begin() + 39, bytes.end()));
  board.wait(0.05);
  CHECK(frames_in(board.events) == frames);
  CHECK(replies_in(board.events) ==
        std::vector<ReplyEvent>{{true, 0x53, {}}, {false, 0x52, {0x03}}});
}

TEST_CASE("a second acknowledgement of Start does not start the count anew", "[parser]") {
  const auto frames = some_frames(6);
  const Bytes bytes = bytes_of(frames, mode);
  Streaming board(mode);
  board.feed(Bytes(bytes.begin(), bytes.begin() + 39) + encode_ack(Id::start) +
             Bytes(bytes.begin() + 39, bytes.end()));
  board.wait(0.05);
  CHECK(frames_in(board.events) == frames);
  CHECK(board.parser.tally().restarts == 0);
}

TEST_CASE("trace frames pass by", "[parser]") {
  const auto frames = some_frames(6);
  const Bytes bytes = bytes_of(frames, mode);
  const Bytes trace{0x41, 0x06, 0x07, 'h', 'e', 'l', 'l', 'o'};
  Streaming board(mode);
  board.feed(Bytes(bytes.begin(), bytes.begin() + 39) + trace +
             Bytes(bytes.begin() + 39, bytes.end()));
  board.wait(0.05);
  CHECK(frames_in(board.events) == frames);
  CHECK(board.parser.tally().bytes_skipped == 0);
}

TEST_CASE("any reply the board may give is an event", "[parser]") {
  const auto replies = [](const Bytes& bytes) {
    Parser parser;
    std::vector<Event> events;
    parser.feed(bytes, Instant{}, events);
    parser.feed({}, Instant{seconds(0.01)}, events);
    return replies_in(events);
  };
  CHECK(replies({0xC0, 0x02, 0x50, 0x00}) == std::vector<ReplyEvent>{{false, 0x50, {0x00}}});
  CHECK(replies({0xC0, 0x02, 0x50, 0x06}) == std::vector<ReplyEvent>{{false, 0x50, {0x06}}});
  CHECK(replies({0xC0, 0x02, 0x50, 0xFF}) == std::vector<ReplyEvent>{{false, 0x50, {0xFF}}});
  CHECK(replies({0xC0, 0x01, 0x50}).empty());  // no code
  CHECK(replies({0x90, 0x01, 0x50}).empty());  // a fragment
  CHECK(replies({0x20, 0x01, 0x00}).empty());  // our own echo
  CHECK(replies({0x80, 0x00, 0x13}).empty());  // length 0
  CHECK(replies({0x80, 0xFF, 0x13}).empty());  // length 255
  CHECK(replies({'A', 'T', '+', 'G', 'C', 'A', 'P', '\r'}).empty());
  const Bytes odd_text{0x80, 0xFF, 0x00, 0x1B};
  CHECK(replies(encode_ack(Id::firmware_version, odd_text)) ==
        std::vector<ReplyEvent>{{true, 0x13, odd_text}});
}

TEST_CASE("frames of another length than the mode's are no data", "[parser]") {
  Streaming board(raw_mode(true, true));
  std::mt19937 random(5);
  const OutputMode shorter = raw_mode(true);
  board.feed(bytes_of(random_frames(30, 1, shorter, random), shorter));
  for (int i = 0; i < 500; ++i) board.wait(1.1);
  CHECK(board.events.empty());
  CHECK(board.parser.tally().bytes_skipped == 30 * 13);
}

TEST_CASE("payloads that look like headers cost nothing in a clean stream", "[parser]") {
  for (const int fill : {0x40, 0x80, 0xC0}) {
    CAPTURE(fill);
    std::vector<DataFrame> frames;
    const OutputMode gyro_only = raw_mode(false, true);
    for (std::uint16_t n = 1; n <= 50; ++n) {
      const auto word = static_cast<std::int16_t>((fill << 8) | fill);
      DataFrame frame{n, {word, word, word}, {0x0B52, 0x0040, 0x0B52}, {word, word, word}, 0, 0,
                      {}};
      frames.push_back(frame);
    }
    Streaming board(gyro_only);
    board.feed(bytes_of(frames, gyro_only));
    board.wait(0.05);
    CHECK(frames_in(board.events).size() == 50);
  }
}

TEST_CASE("a megabyte of noise yields next to nothing and then the stream", "[parser]") {
  const auto seed = GENERATE(range(0u, 5u));
  CAPTURE(seed);
  std::mt19937 random(seed);
  Bytes noise(1 << 20);
  for (auto& byte : noise) byte = static_cast<std::uint8_t>(random());
  Streaming board(mode);
  board.feed(noise);
  CHECK(frames_in(board.events).empty());
  board.wait(1.0);
  board.events.clear();
  const auto frames = some_frames(20);
  board.feed(bytes_of(frames, mode));
  board.wait(0.05);
  CHECK(frames_in(board.events).size() >= 19);
}
