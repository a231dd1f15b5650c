#include "drivers/chamber/modbus_link.h"

#include <catch2/catch.hpp>

#include "drivers/chamber/modbus_chamber.h"
#include "drivers/clocks.h"
#include "tests/drivers/chamber/test_server.h"
#include "tests/drivers/pseudo_terminal.h"

using namespace gyrocal;
using gyrocal::test::Deed;
using gyrocal::test::PseudoTerminal;
using gyrocal::test::TestServer;

namespace {

const Bytes read_two = modbus::encode_request(modbus::read_request(1, 3, 160, 2));
const Bytes read_other = modbus::encode_request(modbus::read_request(1, 3, 1742, 2));
const Bytes write_two = modbus::encode_request(modbus::write_request(1, 16, 1742, {0x41B0, 7}));
const Bytes two_words_of_zero{1, 3, 4, 0, 0, 0, 0};

struct TcpBench {
  explicit TcpBench(std::deque<Deed> deeds) : server(std::move(deeds)) {}
  VirtualClock clock;
  TestServer server;
  ModbusLink link{TcpAddress{"127.0.0.1", server.port}, seconds(0.1), clock};
};

Errc code_after(Deed deed, const Bytes& request) {
  TcpBench bench({deed});
  const auto reply = bench.link.transact(request);
  REQUIRE_FALSE(reply);
  INFO(reply.error().what);
  CHECK(bench.link.transact(read_two) == two_words_of_zero);  // the next attempt is a good one
  return reply.error().code;
}

std::uint16_t crc16(const Bytes& bytes) {
  std::uint32_t crc = 0xFFFF;
  for (const std::uint8_t byte : bytes) {
    crc ^= byte;
    for (int i = 0; i < 8; ++i) crc = (crc & 1) != 0 ? (crc >> 1) ^ 0xA001 : crc >> 1;
  }
  return static_cast<std::uint16_t>(crc);
}

Bytes rtu_frame(Bytes pdu) {
  const std::uint16_t crc = crc16(pdu);
  pdu.push_back(static_cast<std::uint8_t>(crc & 0xFF));
  pdu.push_back(static_cast<std::uint8_t>(crc >> 8));
  return pdu;
}

/// Answers the requests it gets on a pseudo-terminal with what it is given, one after the other.
class RtuDevice {
 public:
  RtuDevice(PseudoTerminal& wire, std::vector<Bytes> replies)
      : thread_([&wire, replies = std::move(replies)] {
          for (const Bytes& reply : replies) {
            wire.receive();
            if (!reply.empty()) wire.send(reply);
          }
        }) {}
  ~RtuDevice() { thread_.join(); }
  RtuDevice(const RtuDevice&) = delete;
  RtuDevice& operator=(const RtuDevice&) = delete;

 private:
  std::thread thread_;
};

}  // namespace

TEST_CASE("requests and replies pass a TCP connection as unit and PDU", "[modbus_link]") {
  TcpBench bench({});
  CHECK(bench.link.transact(write_two) == Bytes{1, 16, 0x06, 0xCE, 0, 2});
  CHECK(bench.link.transact(read_other) == Bytes{1, 3, 4, 0x41, 0xB0, 0, 7});
}

TEST_CASE("an exception is a reply and the connection stays", "[modbus_link]") {
  TcpBench bench({Deed::refuse});
  CHECK(bench.link.transact(read_two) == Bytes{1, 0x83, 2});
  CHECK(bench.link.transact(read_two) == two_words_of_zero);
}

TEST_CASE("no bad reply is taken for a good one, and the next is not spoilt", "[modbus_link]") {
  CHECK(code_after(Deed::half, read_two) == Errc::timeout);
  CHECK(code_after(Deed::other_unit, read_two) == Errc::bad_frame);
  CHECK(code_after(Deed::other_register, write_two) == Errc::bad_frame);
  CHECK(code_after(Deed::hang_up, read_two) == Errc::link_lost);
}

TEST_CASE("a late reply is never another request's", "[modbus_link]") {
  TcpBench bench({Deed::answer, Deed::answer_late});
  REQUIRE(bench.link.transact(write_two));
  const auto late = bench.link.transact(read_other);
  REQUIRE_FALSE(late);
  CHECK(late.error().code == Errc::timeout);
  CHECK_THAT(late.error().what, Catch::Contains("receive: nothing in 0.1 s"));
  CHECK(bench.link.transact(read_two) == two_words_of_zero);
}

TEST_CASE("a doubled reply is not the next request's", "[modbus_link]") {
  TcpBench bench({Deed::answer, Deed::twice});
  REQUIRE(bench.link.transact(write_two));
  CHECK(bench.link.transact(read_other) == Bytes{1, 3, 4, 0x41, 0xB0, 0, 7});
  CHECK(bench.link.transact(read_two) == two_words_of_zero);
}

TEST_CASE("where nobody listens the connection is refused", "[modbus_link]") {
  int port = 0;
  { port = TestServer({}).port; }
  VirtualClock clock;
  ModbusLink link(TcpAddress{"127.0.0.1", port}, seconds(0.1), clock);
  const auto reply = link.transact(read_two);
  REQUIRE_FALSE(reply);
  CHECK(reply.error().code == Errc::link_lost);
  CHECK(reply.error().what ==
        "127.0.0.1:" + std::to_string(port) + ": connect: Connection refused");
}

TEST_CASE("a name is no address", "[modbus_link]") {
  VirtualClock clock;
  ModbusLink link(TcpAddress{"localhost", 502}, seconds(0.1), clock);
  const auto reply = link.transact(read_two);
  REQUIRE_FALSE(reply);
  CHECK(reply.error().code == Errc::bad_input);
  CHECK(reply.error().what == "localhost:502: \"localhost\" is no IPv4 address");
}

TEST_CASE("a unit libmodbus does not know is refused, not sent", "[modbus_link]") {
  TcpBench bench({});
  const Bytes odd = modbus::encode_request(modbus::read_request(248, 3, 160, 2));
  CHECK(bench.link.transact(odd).error().code == Errc::out_of_range);
  CHECK(bench.link.transact(read_two) == two_words_of_zero);
}

TEST_CASE("the chamber's errors say what was asked, of whom, and what came", "[modbus_link]") {
  TcpBench bench({Deed::answer_late});
  ModbusChamber chamber(bench.link, bench.clock, ChamberProfile{}, 1);
  const auto reading = chamber.read();
  REQUIRE_FALSE(reading);
  CHECK(
      to_text(reading.error()) ==
      "read 2 registers at 0: 127.0.0.1:" + std::to_string(bench.server.port) +
          ": receive: nothing in 0.1 s; it took the connection: is that the chamber's Modbus port "
          "(502 to 506 on a Yinhe), its panel in network mode, the unit number right?");
}

TEST_CASE("a web server behind the address is told for what it is", "[modbus_link]") {
  TcpBench bench({Deed::web_page});
  const auto reply = bench.link.transact(read_two);
  REQUIRE_FALSE(reply);
  CHECK(reply.error().code == Errc::bad_frame);
  CHECK(reply.error().what == "127.0.0.1:" + std::to_string(bench.server.port) +
                                  ": what answers there is no Modbus TCP: it begins with "
                                  "\"HTTP/1.1\"");
  CHECK(bench.link.transact(read_two) == two_words_of_zero);
}

TEST_CASE("requests and replies pass an RTU line as unit and PDU", "[modbus_link]") {
  PseudoTerminal wire;
  VirtualClock clock;
  ModbusLink link(RtuAddress{wire.port, 9600, 'N', 1}, seconds(5), clock);
  const RtuDevice device(wire, {rtu_frame(two_words_of_zero), rtu_frame({1, 0x83, 2})});
  CHECK(link.transact(read_two) == two_words_of_zero);
  CHECK(link.transact(read_two) == Bytes{1, 0x83, 2});
  CHECK(clock.now() == Instant{});
}

TEST_CASE("after an error an RTU line is left silent for a reply's time", "[modbus_link]") {
  PseudoTerminal wire;
  VirtualClock clock;
  ModbusLink link(RtuAddress{wire.port, 9600, 'N', 1}, seconds(0.1), clock);
  const RtuDevice device(wire, {{}, rtu_frame(two_words_of_zero)});
  CHECK(link.transact(read_two).error().code == Errc::timeout);
  CHECK(link.transact(read_two) == two_words_of_zero);
  CHECK(clock.now() == Instant{seconds(0.1)});
}

TEST_CASE("a corrupted or a foreign RTU frame is a bad frame", "[modbus_link]") {
  PseudoTerminal wire;
  VirtualClock clock;
  ModbusLink link(RtuAddress{wire.port, 9600, 'N', 1}, seconds(0.5), clock);
  Bytes corrupted = rtu_frame(two_words_of_zero);
  corrupted[4] ^= 1;
  const RtuDevice device(
      wire, {corrupted, rtu_frame({2, 3, 4, 0, 0, 0, 0}), rtu_frame(two_words_of_zero)});
  CHECK(link.transact(read_two).error().code == Errc::bad_frame);
  CHECK(link.transact(read_two).error().code == Errc::bad_frame);
  CHECK(link.transact(read_two) == two_words_of_zero);
}

TEST_CASE("an RTU line has one master", "[modbus_link]") {
  PseudoTerminal wire;
  VirtualClock clock;
  ModbusLink first(RtuAddress{wire.port, 9600, 'N', 1}, seconds(5), clock);
  const RtuDevice device(wire, {rtu_frame(two_words_of_zero)});
  REQUIRE(first.transact(read_two));
  ModbusLink second(RtuAddress{wire.port, 9600, 'N', 1}, seconds(0.1), clock);
  CHECK(second.transact(read_two).error().code == Errc::busy);
}
