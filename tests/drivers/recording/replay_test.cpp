#include <catch2/catch.hpp>

#include "drivers/board/inemo_board.h"
#include "drivers/chamber/modbus_chamber.h"
#include "drivers/clocks.h"
#include "drivers/recording/recording_layers.h"
#include "drivers/recording/replay_layers.h"
#include "drivers/simulated/in_process_links.h"
#include "drivers/simulated/simulated_rig.h"
#include "tests/drivers/recording/temporary_directory.h"

using namespace gyrocal;
using gyrocal::test::TemporaryDirectory;

namespace {

ChamberProfile profile() {
  ChamberProfile yinhe;
  yinhe.name = "test";
  yinhe.temperature_actual.address = 160;
  yinhe.temperature_setpoint.address = 1742;
  return yinhe;
}

/// Never the same moment twice, and sleeps that last too long: as a machine's clock is.
class RestlessClock final : public Clock {
 public:
  explicit RestlessClock(VirtualClock& below) : below_(below) {}
  [[nodiscard]] Instant now() const override {
    below_.sleep_until(below_.now() + Duration{1 + random_() % 3000});
    return below_.now();
  }
  void sleep_until(Instant when) override {
    below_.sleep_until(when + Duration{random_() % 90000});
  }
  [[nodiscard]] std::int64_t utc_ns() const override { return 5'000'000'000 + random_(); }

 private:
  VirtualClock& below_;
  mutable std::minstd_rand random_{3};
};

/// Everything a program saw and made of its devices.
struct Seen {
  std::vector<BoardSample> samples;
  std::vector<ChamberReading> readings;
  std::vector<std::int64_t> times_ns;
  std::vector<Error> errors;
  bool operator==(const Seen&) const = default;
};

/// A program as the daemon is: one thread, a turn every 50 ms, a chamber reading every 5 s.
Seen run(
    Clock& clock, ByteLink& board_link, RequestLink& chamber_link, double setpoint_c,
    const std::function<void(int turn)>& meanwhile = [](int) {}) {
  Seen seen;
  InemoBoard board(board_link, clock);
  ModbusChamber chamber(chamber_link, clock, profile(), 1);
  const auto note = [&seen](const auto& result) {
    if (!result) seen.errors.push_back(result.error());
    return result.has_value();
  };
  seen.times_ns.push_back(clock.utc_ns());
  note(board.open({}));
  note(board.start());
  note(chamber.set_setpoint(Celsius{setpoint_c}));
  for (int turn = 0; turn < 2000; ++turn) {
    meanwhile(turn);
    if (!note(board.drain(seen.samples)) && note(board.open({}))) note(board.start());
    if (turn % 100 == 0) {
      if (const auto reading = chamber.read(); note(reading)) seen.readings.push_back(*reading);
    }
    seen.times_ns.push_back(clock.now().time_since_epoch().count());
    clock.sleep_until(clock.now() + seconds(0.05));
  }
  return seen;
}

Seen record(const std::string& path) {
  VirtualClock virtual_clock;
  SimulatedRig rig(rig::RigModel{}, 7, 1, profile(), 1);
  RestlessClock clock(virtual_clock);
  InProcessBoardLink board(rig.board(0), virtual_clock);
  InProcessChamberLink chamber(rig.chamber(), virtual_clock, seconds(1));
  const RecordedRun description{1, 0, "0.1.0", "", "", {"chamber", "board left"}};
  const auto writer = RecordingWriter::open(path, description, seconds(30));
  REQUIRE(writer);
  Recorder recorder(clock, **writer);
  RecordingClock recording_clock(recorder);
  RecordingRequestLink recorded_chamber(chamber, recorder, 1);
  RecordingByteLink recorded_board(board, recorder, 2);
  return run(recording_clock, recorded_board, recorded_chamber, 25, [&](int turn) {
    if (turn == 700) rig.board(0).unplug(virtual_clock.now());
    if (turn == 900) rig.board(0).plug_in(virtual_clock.now());
  });
}

struct Replayed {
  Seen seen;
  std::optional<Divergence> diverged;
  bool ended = false;
};

Replayed replay(const std::string& path, double setpoint_c) {
  auto reader = RecordingReader::open(path, 1);
  REQUIRE(reader);
  Tape tape(std::move(*reader), recorded_runs(path)->front());
  ReplayClock clock(tape);
  ReplayRequestLink chamber(tape, 1);
  ReplayByteLink board(tape, 2);
  Seen seen = run(clock, board, chamber, setpoint_c);
  CHECK_FALSE(tape.trouble());
  return {std::move(seen), tape.diverged(), tape.ended()};
}

}  // namespace

TEST_CASE("a replay is the recorded run to the last bit", "[replay]") {
  const TemporaryDirectory directory;
  const std::string path = directory.file("a.recording.db");
  const Seen recorded = record(path);
  REQUIRE(recorded.samples.size() > 4000);
  REQUIRE(recorded.readings.size() == 20);
  REQUIRE_FALSE(recorded.errors.empty());  // the board was away for a while
  const Replayed replayed = replay(path, 25);
  CHECK(replayed.seen == recorded);
  CHECK_FALSE(replayed.diverged);
  CHECK(replayed.ended);
}

TEST_CASE("a program that does something else diverges where it does", "[replay]") {
  const TemporaryDirectory directory;
  const std::string path = directory.file("a.recording.db");
  record(path);
  const Replayed replayed = replay(path, 24);
  REQUIRE(replayed.diverged);
  CHECK(replayed.diverged->recorded == "ask chamber 01 10 06 ce 00 02 04 41 c8 00 00");
  CHECK(replayed.diverged->replayed == "ask chamber 01 10 06 ce 00 02 04 41 c0 00 00");
  CHECK(replayed.diverged->at > Instant{});
  CHECK_FALSE(replayed.seen.errors.empty());
}

TEST_CASE("a recording cut off by a crash replays up to there and then ends", "[replay]") {
  const TemporaryDirectory directory;
  const std::string path = directory.file("a.recording.db");
  record(path);
  const std::string shorter = directory.file("b.recording.db");
  {
    auto reader = RecordingReader::open(path, 1);
    REQUIRE(reader);
    const auto writer = RecordingWriter::open(shorter, recorded_runs(path)->front(), seconds(30));
    for (int i = 0; i < 3000; ++i) (*writer)->append(**reader->next());
  }
  const Replayed replayed = replay(shorter, 25);
  CHECK_FALSE(replayed.diverged);
  CHECK(replayed.ended);
  CHECK(replayed.seen.errors.back().code == Errc::link_lost);
}
