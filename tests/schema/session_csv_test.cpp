#include "schema/session/session_csv.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <random>

#include "tests/schema/small_session.h"
#include "tests/schema/temporary_folder.h"

using namespace gyrocal;

namespace {

bool same(double a, double b) {  // to the last bit; missing equals missing
  return std::memcmp(&a, &b, sizeof a) == 0 || (std::isnan(a) && std::isnan(b));
}

bool same(const Session& a, const Session& b) {
  bool equal = a.device == b.device && a.axis == b.axis && a.sample_rate_hz == b.sample_rate_hz &&
               a.monitor_interval_s == b.monitor_interval_s && a.lsb_dps == b.lsb_dps &&
               a.samples_per_dwell == b.samples_per_dwell && a.dwells.size() == b.dwells.size() &&
               a.monitor.size() == b.monitor.size() && a.samples.size() == b.samples.size();
  for (std::size_t i = 0; equal && i < a.dwells.size(); ++i) {
    equal = a.dwells[i].dwell == b.dwells[i].dwell &&
            same(a.dwells[i].setpoint_c, b.dwells[i].setpoint_c) &&
            same(a.dwells[i].t_start_s, b.dwells[i].t_start_s);
  }
  for (std::size_t i = 0; equal && i < a.monitor.size(); ++i) {
    const auto& x = a.monitor[i];
    const auto& y = b.monitor[i];
    equal = same(x.t_s, y.t_s) && same(x.setpoint_c, y.setpoint_c) &&
            same(x.chamber_c, y.chamber_c) && same(x.board_c, y.board_c) &&
            same(x.gyro_dps, y.gyro_dps);
  }
  for (std::size_t i = 0; equal && i < a.samples.size(); ++i) {
    const auto& x = a.samples[i];
    const auto& y = b.samples[i];
    equal = x.dwell == y.dwell && x.seq == y.seq && same(x.t_s, y.t_s) &&
            same(x.gyro_dps, y.gyro_dps) && same(x.acc_g[0], y.acc_g[0]) &&
            same(x.acc_g[1], y.acc_g[1]) && same(x.acc_g[2], y.acc_g[2]) &&
            same(x.board_c, y.board_c) && same(x.chamber_c, y.chamber_c);
  }
  return equal;
}

Session read_back(const TemporaryFolder& folder) {
  auto session = read_session(folder / "s");
  if (!session) FAIL(session.error().what);
  return *session;
}

}  // namespace

TEST_CASE("a session comes back from its directory to the last bit", "[session]") {
  const TemporaryFolder folder;
  auto session = small_session();
  SECTION("everything measured") {}
  SECTION("no chamber column, no accelerometer, holes in the rest") {
    for (auto& row : session.monitor) row.chamber_c = missing;
    for (auto& row : session.samples) row.acc_g = {missing, missing, missing};
    session.monitor[3].gyro_dps = missing;
    session.samples[5].board_c = missing;
    session.dwells[1].setpoint_c = missing;
  }
  SECTION("gaps in the record and lost samples") {
    session.monitor.erase(session.monitor.begin() + 3, session.monitor.begin() + 6);
    session.samples.erase(session.samples.begin() + 4, session.samples.begin() + 6);
  }
  SECTION("one dwell") {
    session.dwells.pop_back();
    session.samples.resize(12);
  }
  REQUIRE(write_session(folder / "s", session));
  CHECK(same(read_back(folder), session));
}

TEST_CASE("whatever the numbers, they are read back as they were", "[session][property]") {
  const auto seed = GENERATE(range(0u, 20u));
  CAPTURE(seed);
  std::mt19937_64 random(seed);
  const auto any = [&random] {  // every finite double, evenly over its bits
    for (;;) {
      const auto bits = random();
      double value = 0;
      std::memcpy(&value, &bits, sizeof value);
      if (std::isfinite(value)) return value;
    }
  };
  auto session = small_session();
  for (auto& row : session.monitor) {
    row.gyro_dps = any();
    row.board_c = any();
  }
  for (auto& row : session.samples) row.gyro_dps = any();
  const TemporaryFolder folder;
  REQUIRE(write_session(folder / "s", session));
  CHECK(same(read_back(folder), session));
}

TEST_CASE("other people's files are read: order of columns, CRLF, a mark, columns of their own",
          "[session]") {
  const TemporaryFolder folder;
  REQUIRE(write_session(folder / "s", small_session()));
  write_file(folder / "s/monitor.csv",
             "\xEF\xBB\xBF"
             "humidity, gyro_z_dps,t_s\r\n50,4.5,10\r\n51,+4.25e0,60\r\n\r\n");
  const auto session = read_back(folder);
  REQUIRE(session.monitor.size() == 2);
  CHECK(session.monitor[0].t_s == 10);
  CHECK(session.monitor[0].gyro_dps == 4.5);
  CHECK(session.monitor[1].gyro_dps == 4.25);
  CHECK(std::isnan(session.monitor[0].chamber_c));
}

TEST_CASE("dwells sorted by their number come back sorted by time", "[session]") {
  const TemporaryFolder folder;
  auto session = small_session();
  session.dwells = {{1, -10, 20}, {0, 20, 40}};
  for (auto& sample : session.samples) sample.dwell = 1 - sample.dwell;
  const auto in_time_order = session;
  std::swap(session.dwells[0], session.dwells[1]);
  std::rotate(session.samples.begin(), session.samples.begin() + 12, session.samples.end());
  REQUIRE(write_session(folder / "s", session));
  CHECK(same(read_back(folder), in_time_order));
}

TEST_CASE("a session written over another replaces it; a failed one leaves no head", "[session]") {
  const TemporaryFolder folder;
  REQUIRE(write_session(folder / "s", small_session()));
  auto other = small_session();
  other.device.push_back('s');
  REQUIRE(write_session(folder / "s", other));
  CHECK(read_back(folder).device == "benchs");
  std::filesystem::remove(folder / "s/samples.csv");
  std::filesystem::create_directories(folder / "s/samples.csv/in the way");
  const auto failed = write_session(folder / "s", other);
  REQUIRE_FALSE(failed.has_value());
  CHECK_THAT(failed.error().what, Catch::StartsWith("write " + folder / "s/samples.csv" + ": "));
  CHECK_FALSE(std::filesystem::exists(folder / "s/session.json"));
}
