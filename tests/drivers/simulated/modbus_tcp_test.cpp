#include <arpa/inet.h>
#include <modbus.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include "tests/drivers/simulated/running_rig.h"
#include "tests/drivers/simulated/served_rig.h"

using namespace gyrocal;

namespace {

/// A client with bare sockets, for what libmodbus would never send.
class BareClient {
 public:
  explicit BareClient(int port) : fd_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(port));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    REQUIRE(::connect(fd_.get(), reinterpret_cast<sockaddr*>(&address), sizeof address) == 0);
  }
  void send(const std::string& text) const {
    const Bytes data = bytes(text);
    REQUIRE(::send(fd_.get(), data.data(), data.size(), MSG_NOSIGNAL) ==
            static_cast<ssize_t>(data.size()));
  }
  /// "closed" once the server has hung up.
  [[nodiscard]] std::string receive() const {
    std::array<std::uint8_t, 512> into;
    const ssize_t count = ::recv(fd_.get(), into.data(), into.size(), MSG_DONTWAIT);
    if (count == 0) return "closed";
    return hex(std::span(into).first(static_cast<std::size_t>(count < 0 ? 0 : count)));
  }

 private:
  UniqueFd fd_;
};

struct ModbusClient {
  explicit ModbusClient(int port, int unit = 1) : context(modbus_new_tcp("127.0.0.1", port)) {
    REQUIRE(modbus_set_slave(context, unit) == 0);
    REQUIRE(modbus_connect(context) == 0);
  }
  ~ModbusClient() {
    modbus_close(context);
    modbus_free(context);
  }
  ModbusClient(const ModbusClient&) = delete;
  ModbusClient& operator=(const ModbusClient&) = delete;
  std::array<std::uint16_t, 2> read(int address) {
    std::array<std::uint16_t, 2> words{};
    REQUIRE(modbus_read_registers(context, address, 2, words.data()) == 2);
    return words;
  }
  modbus_t* context;
};

const std::string pv = "03 00 a0 00 02";
const std::string pv_reply = "03 04 41 b8 00 00";

}  // namespace

TEST_CASE("libmodbus reads and writes the chamber over real TCP, two clients at once",
          "[simulated][modbus]") {
  RunningRig rig;
  ModbusClient first(rig.port());
  ModbusClient second(rig.port());
  const std::array<std::uint16_t, 2> minus_ten{0xC120, 0x0000};
  CHECK(modbus_write_registers(first.context, 1742, 2, minus_ten.data()) == 2);
  CHECK(second.read(1742) == minus_ten);
  CHECK(first.read(160) == std::array<std::uint16_t, 2>{0x41B8, 0x0000});
  CHECK(modbus_write_register(second.context, 200, 1) == -1);
  CHECK(errno == EMBXILADD);
  const std::uint16_t run = 1;
  CHECK(modbus_write_registers(second.context, 200, 1, &run) == 1);
  std::uint16_t state = 0;
  CHECK(modbus_read_registers(first.context, 200, 1, &state) == 1);
  CHECK(state == 1);
  CHECK(rig.end());
}

TEST_CASE("libmodbus gets an exception for a hole and time-out from the wrong unit",
          "[simulated][modbus]") {
  RunningRig rig;
  ModbusClient client(rig.port());
  std::array<std::uint16_t, 8> words{};
  CHECK(modbus_read_registers(client.context, 0, 8, words.data()) == -1);
  CHECK(errno == EMBXILADD);
  CHECK(modbus_read_registers(client.context, 160, 2, words.data()) == 2);
  ModbusClient stranger(rig.port(), 7);
  CHECK(modbus_read_registers(stranger.context, 160, 2, words.data()) == -1);
  CHECK(errno == ETIMEDOUT);
}

TEST_CASE("a reply carries its request's transaction id", "[simulated][modbus]") {
  ServedRig rig(0);
  const BareClient client(rig.server->port());
  client.send("ab cd 00 00 00 06 01 " + pv);
  rig.turn();
  CHECK(client.receive() == "ab cd 00 00 00 07 01 " + pv_reply);
}

TEST_CASE("requests that arrive byte by byte or several at once are all answered",
          "[simulated][modbus]") {
  ServedRig rig(0);
  const BareClient client(rig.server->port());
  const std::string request = "00 01 00 00 00 06 01 " + pv;
  SECTION("byte by byte") {
    for (std::size_t at = 0; at < request.size(); at += 3) {
      CHECK(client.receive().empty());
      client.send(request.substr(at, 2));
      rig.turn();
    }
    CHECK(client.receive() == "00 01 00 00 00 07 01 " + pv_reply);
  }
  SECTION("two and a half") {
    client.send(request + " " + request + " 00 01 00 00");
    rig.turn();
    const std::string reply = "00 01 00 00 00 07 01 " + pv_reply;
    CHECK(client.receive() == reply + " " + reply);
    client.send("00 06 01 " + pv);
    rig.turn();
    CHECK(client.receive() == reply);
  }
  SECTION("an unknown function, of any length, leaves nothing behind") {
    client.send("00 02 00 00 00 09 01 2b 0e 01 00 11 22 33 44 " + request);
    rig.turn();
    CHECK(client.receive() == "00 02 00 00 00 03 01 ab 01 00 01 00 00 00 07 01 " + pv_reply);
  }
}

TEST_CASE("what is no Modbus closes the connection, and only that one", "[simulated][modbus]") {
  for (const char* noise : {"47 45 54 20 2f 20", "00 01 00 07 00 06", "00 01 00 00 00 01",
                            "00 01 00 00 01 00", "00 01 00 00 ff ff"}) {
    ServedRig rig(0);
    const BareClient good(rig.server->port());
    const BareClient bad(rig.server->port());
    bad.send(noise);
    rig.turn();
    CHECK(bad.receive() == "closed");
    good.send("00 01 00 00 00 06 01 " + pv);
    rig.turn();
    CHECK(good.receive() == "00 01 00 00 00 07 01 " + pv_reply);
    CHECK(rig.server->client_count() == 1);
  }
}

TEST_CASE("a client that stops in the middle of a request is dropped, others are served meanwhile",
          "[simulated][modbus]") {
  ServedRig rig(0);
  auto server = ModbusTcpServer::open("127.0.0.1", 0);
  REQUIRE(server.has_value());
  const auto handler = [&](std::span<const std::uint8_t> request) {
    auto reply = rig.rig.chamber().answer(request, at_s(0));
    REQUIRE(reply.has_value());
    return ChamberAnswer{ChamberAnswer::Way::whole, *reply, {}};
  };
  const ModbusTcpServer::WallTime start{};
  const BareClient half(server->port());
  const BareClient whole(server->port());
  half.send("00 01 00 00 00 06 01 03");
  whole.send("00 01 00 00 00 06 01 " + pv);
  server->serve(start, handler);
  CHECK(whole.receive() == "00 01 00 00 00 07 01 " + pv_reply);
  CHECK(server->deadline() == start + std::chrono::seconds(1));
  server->serve(start + std::chrono::milliseconds(999), handler);
  CHECK(server->client_count() == 2);
  server->serve(start + std::chrono::seconds(1), handler);
  CHECK(server->client_count() == 1);
  CHECK(half.receive() == "closed");
  CHECK_FALSE(server->deadline().has_value());
}

TEST_CASE("clients that go are forgotten; the 17th at once is turned away", "[simulated][modbus]") {
  ServedRig rig(0);
  {
    std::vector<std::unique_ptr<BareClient>> clients;
    for (int i = 0; i < 17; ++i) {
      clients.push_back(std::make_unique<BareClient>(rig.server->port()));
    }
    rig.turn();
    CHECK(rig.server->client_count() == 16);
    CHECK(clients.back()->receive() == "closed");
  }
  rig.turn();
  CHECK(rig.server->client_count() == 0);
}

TEST_CASE("a port that is taken is said to be", "[simulated][modbus]") {
  ServedRig rig(0);
  const auto second = ModbusTcpServer::open("127.0.0.1", rig.server->port());
  REQUIRE_FALSE(second.has_value());
  CHECK(second.error().code == Errc::busy);
  CHECK(second.error().what.find("Address already in use") != std::string::npos);
  CHECK(ModbusTcpServer::open("localhost", 0).error().code == Errc::bad_input);
}
