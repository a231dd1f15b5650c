#include "drivers/board/inemo_board.h"

#include <catch2/catch.hpp>
#include <deque>

#include "drivers/clocks.h"
#include "drivers/recording/faulty_link.h"
#include "drivers/simulated/in_process_links.h"
#include "drivers/simulated/simulated_rig.h"

using namespace gyrocal;

namespace {

ChamberProfile any_profile() {
  ChamberProfile profile;
  profile.temperature_actual.address = 160;
  profile.temperature_setpoint.address = 1742;
  return profile;
}

struct Bench {
  VirtualClock clock;
  SimulatedRig rig{rig::RigModel{}, 7, 1, any_profile(), 1};
  InProcessBoardLink link{rig.board(0), clock};
  InemoBoard board{link, clock};

  void pass(double s) { clock.sleep_until(clock.now() + seconds(s)); }
};

/// Answers each write with the next of the replies it was given.
class ScriptedLink final : public ByteLink {
 public:
  explicit ScriptedLink(std::deque<Bytes> replies) : replies_(std::move(replies)) {}
  Result<std::size_t> read(std::span<std::uint8_t> into) override {
    const std::size_t count = std::min(into.size(), arrived_.size());
    std::copy_n(arrived_.begin(), count, into.begin());
    arrived_.erase(arrived_.begin(), arrived_.begin() + static_cast<std::ptrdiff_t>(count));
    return count;
  }
  Result<void> write(std::span<const std::uint8_t> bytes) override {
    written.emplace_back(bytes.begin(), bytes.end());
    if (replies_.empty()) return {};
    arrived_.insert(arrived_.end(), replies_.front().begin(), replies_.front().end());
    replies_.pop_front();
    return {};
  }
  Result<void> reopen() override { return {}; }

  std::vector<Bytes> written;

 private:
  std::deque<Bytes> replies_;
  Bytes arrived_;
};

Bytes text_reply(inemo::Id id, const std::string& text) {
  return inemo::encode_ack(id, Bytes(text.begin(), text.end()));
}

Error error_of_open(std::deque<Bytes> replies) {
  VirtualClock clock;
  ScriptedLink link(std::move(replies));
  InemoBoard board(link, clock);
  const auto opened = board.open({});
  REQUIRE_FALSE(opened);
  return opened.error();
}

const Bytes connected = inemo::encode_ack(inemo::Id::connect);
const Bytes stopped = inemo::encode_ack(inemo::Id::stop);
const Bytes firmware = text_reply(inemo::Id::firmware_version, "iNEMO Firmware_Version_2.2");
const Bytes hardware = text_reply(inemo::Id::hardware_version, "iNEMO V2 Hardware_Version_1");
const Bytes mcu_id =
    inemo::encode_ack(inemo::Id::mcu_id, Bytes{12, 11, 10, 9, 8, 7, 6, 5, 4, 3, 2, 1});
const Bytes mode_set = inemo::encode_ack(inemo::Id::set_output_mode);

}  // namespace

TEST_CASE("a board is opened, identified and streams raw counts", "[board]") {
  Bench bench;
  const auto identity = bench.board.open({});
  REQUIRE(identity);
  CHECK(identity->firmware_version == "iNEMO Firmware_Version_2.2");
  CHECK(identity->hardware_version == "iNEMO V2 Hardware_Version_1");
  CHECK(identity->mcu_id.size() == 24);
  REQUIRE(bench.board.start());
  const Instant started = bench.clock.now();
  bench.pass(60.005);
  std::vector<BoardSample> samples;
  REQUIRE(bench.board.drain(samples));
  bench.pass(0.1);
  REQUIRE(bench.board.drain(samples));
  REQUIRE(samples.size() >= 3000);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    CHECK(samples[i].counter == i + 1);
    CHECK(samples[i].temperature_raw.has_value());
  }
  CHECK(bench.board.tally().frames == samples.size());
  CHECK(bench.board.tally().missing == 0);
  CHECK(std::abs(samples[2999].t_ns - (started + seconds(60)).time_since_epoch().count()) <
        30'000'000);
}

TEST_CASE("sample times lie a period apart and only grow", "[board]") {
  Bench bench;
  REQUIRE(bench.board.open({}));
  REQUIRE(bench.board.start());
  std::vector<BoardSample> samples;
  for (int i = 0; i < 500; ++i) {
    bench.pass(0.37);
    REQUIRE(bench.board.drain(samples));
  }
  REQUIRE(samples.size() > 9000);
  for (std::size_t i = 1; i < samples.size(); ++i) {
    CHECK(samples[i].t_ns > samples[i - 1].t_ns);
    if (i > 1000) CHECK(std::abs(samples[i].t_ns - samples[i - 1].t_ns - 20'000'000) < 100'000);
  }
  CHECK(bench.board.tally().ticks_missed == 0);
}

TEST_CASE("samples that came before Stop are not lost, later ones never come", "[board]") {
  Bench bench;
  REQUIRE(bench.board.open({}));
  REQUIRE(bench.board.start());
  bench.pass(1.0);
  REQUIRE(bench.board.stop());
  std::vector<BoardSample> samples;
  REQUIRE(bench.board.drain(samples));
  CHECK(samples.size() >= 50);
  const auto count = samples.size();
  bench.pass(1.0);
  REQUIRE(bench.board.drain(samples));
  CHECK(samples.size() == count);
}

TEST_CASE("a board left streaming by a host that died is taken over", "[board]") {
  Bench bench;
  REQUIRE(bench.board.open({400, true, false}));
  REQUIRE(bench.board.start());
  bench.pass(3.0);
  InemoBoard next(bench.link, bench.clock);
  REQUIRE(next.open({}));
  REQUIRE(next.start());
  bench.pass(1.0);
  std::vector<BoardSample> samples;
  REQUIRE(next.drain(samples));
  REQUIRE_FALSE(samples.empty());
  CHECK(samples.front().counter == 1);
  CHECK(next.tally().bytes_skipped == 0);
}

TEST_CASE("an unplugged board is a lost link, plugged in again it streams again", "[board]") {
  Bench bench;
  REQUIRE(bench.board.open({}));
  REQUIRE(bench.board.start());
  bench.pass(1.0);
  bench.rig.board(0).unplug(bench.clock.now());
  std::vector<BoardSample> samples;
  CHECK(bench.board.drain(samples).error().code == Errc::link_lost);
  CHECK(bench.board.open({}).error().code == Errc::link_lost);
  bench.rig.board(0).plug_in(bench.clock.now());
  bench.pass(1.0);
  REQUIRE(bench.board.open({}));
  REQUIRE(bench.board.start());
  samples.clear();
  bench.pass(1.0);
  REQUIRE(bench.board.drain(samples));
  REQUIRE(samples.size() >= 49);
  CHECK(samples.front().counter == 1);
}

TEST_CASE("a rate the firmware does not know is refused before anything is sent", "[board]") {
  VirtualClock clock;
  ScriptedLink link({});
  InemoBoard board(link, clock);
  const auto opened = board.open({60, false, true});
  REQUIRE_FALSE(opened);
  CHECK(opened.error().code == Errc::out_of_range);
  CHECK(opened.error().what == "sample rate 60 Hz");
  CHECK(link.written.empty());
}

TEST_CASE("start-up sends one command a write, in the order the board needs", "[board]") {
  VirtualClock clock;
  const Bytes mode = inemo::encode_ack(inemo::Id::get_output_mode, Bytes{0x29, 0x18, 0, 0});
  ScriptedLink link({connected, stopped, firmware, hardware, mcu_id, mode_set, mode,
                     inemo::encode_ack(inemo::Id::start)});
  InemoBoard board(link, clock);
  const auto identity = board.open({});
  REQUIRE(identity);
  CHECK(identity->mcu_id == "0102030405060708090a0b0c");
  REQUIRE(board.start());
  CHECK(link.written == std::vector<Bytes>{{0x20, 0x01, 0x00},
                                           {0x20, 0x01, 0x53},
                                           {0x20, 0x01, 0x13},
                                           {0x20, 0x01, 0x14},
                                           {0x20, 0x01, 0x12},
                                           {0x20, 0x05, 0x50, 0x29, 0x18, 0x00, 0x00},
                                           {0x20, 0x01, 0x51},
                                           {0x20, 0x01, 0x52}});
}

TEST_CASE("a device that says nothing is asked three times", "[board]") {
  VirtualClock clock;
  ScriptedLink link({});
  InemoBoard board(link, clock);
  const auto opened = board.open({});
  REQUIRE_FALSE(opened);
  CHECK(to_text(opened.error()) ==
        "Connect (00): no reply, 3 x 0.5 s; is this an iNEMO V2, and does nothing else "
        "use its port?");
  CHECK(link.written.size() == 3);
  CHECK(clock.now() == Instant{seconds(1.5)});
}

TEST_CASE("what is no iNEMO V2 is a mismatch that says what it is", "[board]") {
  const Error m1 = error_of_open(
      {connected, stopped, firmware, text_reply(inemo::Id::hardware_version, "iNEMO M1")});
  CHECK(m1.code == Errc::mismatch);
  CHECK(m1.what ==
        "is \"iNEMO M1\" with \"iNEMO Firmware_Version_2.2\", expected an iNEMO V2");
  const Error noise = error_of_open(
      {connected, stopped, inemo::encode_ack(inemo::Id::firmware_version, Bytes{0xFF, 0x00})});
  CHECK(noise.code == Errc::mismatch);
  const Bytes modem{'A', 'T', '\r', '\r', '\n', 'O', 'K', '\r', '\n'};
  CHECK(error_of_open({modem, modem, modem}).code == Errc::timeout);
}

TEST_CASE("a mode that is not taken is a mismatch, a refusal names its reason", "[board]") {
  const Error mode =
      error_of_open({connected, stopped, firmware, hardware, mcu_id, mode_set,
                     inemo::encode_ack(inemo::Id::get_output_mode, Bytes{0x29, 0x10, 0, 0})});
  CHECK(mode.code == Errc::mismatch);
  CHECK(mode.what == "set output mode 29 18 00 00, read back 29 10 00 00");
  const Error refused = error_of_open({connected, stopped, firmware, hardware, mcu_id,
                                       inemo::encode_nack(0x50, inemo::Nack::out_of_range)});
  CHECK(refused.code == Errc::refused);
  CHECK(refused.what == "Set output mode (50) was refused: 02 value out of range");
}

TEST_CASE("a lost reply to Start is healed by Stop and Start", "[board]") {
  VirtualClock clock;
  const Bytes mode = inemo::encode_ack(inemo::Id::get_output_mode, Bytes{0x29, 0x18, 0, 0});
  ScriptedLink link({connected,
                     stopped,
                     firmware,
                     hardware,
                     mcu_id,
                     mode_set,
                     mode,
                     {},
                     stopped,
                     inemo::encode_ack(inemo::Id::start)});
  InemoBoard board(link, clock);
  REQUIRE(board.open({}));
  CHECK(board.start());
  CHECK(link.written.back() == Bytes{0x20, 0x01, 0x52});
  CHECK(link.written[link.written.size() - 2] == Bytes{0x20, 0x01, 0x53});
}

TEST_CASE("whichever call of the link fails, nothing hangs and a board reported open is open",
          "[board][fault]") {
  std::size_t failures = 0;
  for (std::size_t n = 0;; ++n) {
    CAPTURE(n);
    Bench bench;
    FaultyByteLink faulty(bench.link, {n, Errc::link_lost});
    InemoBoard board(faulty, bench.clock);
    const auto opened = board.open({});
    if (opened && board.start() && bench.rig.board(0).streaming()) {
      CHECK(opened->mcu_id.size() == 24);
    } else {
      ++failures;
      CHECK(board.open({}));  // and the next attempt succeeds
    }
    if (!faulty.fired()) break;
  }
  CHECK(failures >= 9);  // reopening and eight commands
}
