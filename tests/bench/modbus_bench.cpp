#include <fmt/format.h>
#include <modbus/modbus.h>

#include <array>
#include <memory>
#include <nlohmann/json.hpp>

#include "drivers/chamber/modbus_chamber.h"
#include "drivers/chamber/modbus_link.h"
#include "drivers/clocks.h"
#include "tests/bench/child_process.h"
#include "tests/bench/python_peer.h"
#include "tests/bench/sample_campaign.h"
#include "tests/bench/scratch.h"
#include "tests/bench/sections.h"

namespace gyrocal::bench {
namespace {

constexpr int readings = 2000;

struct RoundTrips {
  std::vector<double> wall_s;
  std::vector<double> cpu_s;
  template <class Read>
  bool time(Read read) {
    const double cpu = cpu_now_s();
    const double wall = wall_now_s();
    const bool done = read();
    wall_s.push_back(wall_now_s() - wall);
    cpu_s.push_back(cpu_now_s() - cpu);
    return done;
  }
};

/// What ModbusChamber::read() asks for by the Yinhe profile, and nothing else.
bool read_bare(modbus_t* modbus) {
  std::array<std::uint16_t, 2> words{};
  return modbus_read_registers(modbus, 160, 2, words.data()) == 2 &&
         modbus_read_registers(modbus, 1742, 2, words.data()) == 2 &&
         modbus_read_registers(modbus, 200, 1, words.data()) == 1 &&
         modbus_read_registers(modbus, 202, 1, words.data()) == 1;
}

struct Free {
  void operator()(modbus_t* modbus) const {
    modbus_close(modbus);
    modbus_free(modbus);
  }
};
using ModbusHandle = std::unique_ptr<modbus_t, Free>;

Rows measure(const ChamberProfile& profile, const std::string& host, int port, int unit) {
  ScaledClock clock;
  ModbusLink link(TcpAddress{host, port}, seconds(1), clock);
  ModbusChamber chamber(link, clock, profile, unit);
  const ModbusHandle bare(modbus_new_tcp(host.c_str(), port));
  if (!bare || modbus_set_slave(bare.get(), unit) != 0 || modbus_connect(bare.get()) != 0) {
    return {failed("a reading of the chamber", "libmodbus did not connect")};
  }
  RoundTrips ours;
  RoundTrips peer;
  bool done = true;
  for (int i = 0; i < readings && done; ++i) {  // by turns
    done = ours.time([&] { return chamber.read().has_value(); }) &&
           peer.time([&] { return read_bare(bare.get()); });
  }
  if (!done) return {failed("a reading of the chamber", "the simulated chamber did not answer")};
  const auto python = ask_python("modbus_peer.py", {host, std::to_string(port)});
  Peer pymodbus{"pymodbus", {}, "python3-pymodbus python3-serial-asyncio"};
  if (python) {
    pymodbus.name += " " + python->at("version").get<std::string>();
    pymodbus.took_s = spread_from(python->at("wall_s"));
  }
  const std::string libmodbus = "libmodbus " LIBMODBUS_VERSION_STRING;
  const Spread wall = spread_of(ours.wall_s);
  return {against("a reading of the chamber: 4 round trips, wall", wall,
                  {libmodbus, spread_of(peer.wall_s), ""}, 1 / 1.3, "the same requests, by turns"),
          against("the same, CPU of the client", spread_of(ours.cpu_s),
                  {libmodbus, spread_of(peer.cpu_s), ""}, {},
                  "each reply is held against its request, what came unasked is thrown away"),
          against("the same, wall, beside a script", wall, pymodbus, {}, "")};
}

}  // namespace

Rows modbus_rows() {
  const auto campaign = demo_campaign();
  if (!campaign) return {failed("a reading of the chamber", campaign.error().what)};
  const Scratch folder;
  BackgroundProcess rig({GYROCAL_PROGRAM, "rig", "serve", "--boards", "1", "--port", "0",
                         "--link-dir", folder / "boards", "--json"});
  const auto served = nlohmann::json::parse(rig.read_line(), nullptr, false);
  if (served.is_discarded()) {
    return {failed("a reading of the chamber", "gyrocal rig serve did not begin")};
  }
  const auto& chamber = served.at("chamber");
  return measure(campaign->chamber.profile, chamber.at("host"), chamber.at("port"),
                 chamber.at("unit"));
}

}  // namespace gyrocal::bench
