#include "config/chamber_profile.h"

#include <catch2/catch.hpp>
#include <filesystem>
#include <string>

using namespace gyrocal;

namespace {

const std::string registers = R"(
[registers.temperature_actual]
address = 0
[registers.temperature_setpoint]
address = 43
type = "int16"
scale = 0.01
write_function = 6
)";

}  // namespace

TEST_CASE("every shipped chamber profile is sound", "[config]") {
  int profiles = 0;
  for (const auto& entry :
       std::filesystem::directory_iterator(GYROCAL_SOURCE_DIR "/config/chambers")) {
    const auto profile = read_chamber_profile(entry.path().string());
    if (!profile) FAIL(profile.error().what);
    ++profiles;
  }
  CHECK(profiles >= 1);
}

TEST_CASE("a profile holds what its file says, absent registers stay absent", "[config]") {
  const auto profile = parse_chamber_profile(
      "name = \"small\"\nunit = 3\nlimit_min_c = -40\n" + registers +
          "[registers.run_command]\naddress = 101\ntype = \"uint16\"\nwrite_function = 6\n"
          "values = { running = 1, stopped = 4 }\n",
      "p.toml");
  if (!profile) FAIL(profile.error().what);
  CHECK(profile->unit_default == 3);
  CHECK(profile->limit_min == Celsius{-40});
  CHECK(profile->limit_max == Celsius{90});
  CHECK(profile->temperature_actual == RegisterSpec{});
  CHECK(profile->temperature_setpoint ==
        RegisterSpec{43, RegisterType::int16, WordOrder::high_word_first, 0.01, 3, 6});
  CHECK_FALSE(profile->run_state.has_value());
  REQUIRE(profile->run_command.has_value());
  CHECK(profile->run_command->values == std::map<std::string, int>{{"running", 1}, {"stopped", 4}});
}

TEST_CASE("each mistake in a profile is named with its place", "[config][bad]") {
  struct Broken {
    std::string text;
    std::string message;
  };
  const auto broken = GENERATE(values<Broken>({
      {"[registers]\n", "p.toml:1: registers.temperature_actual is missing: expected a table"},
      {registers + "[registers.run_state]\naddress = 1\n",
       "registers.run_state.values is missing: expected a table [registers.run_state.values]"},
      {registers + "[registers.run_state]\naddress = 1\nvalues = { on = 1 }\n",
       "unknown key registers.run_state.values.on = 1: known here: stopped, running, paused"},
      {"[registers.temperature_actual]\naddress = 70000\n",
       "temperature_actual.address = 70000: expected a whole number from 0 to 65535"},
      {"[registers.temperature_actual]\ntype = \"float64\"\n", "address is missing: expected the"},
      {"[registers.temperature_actual]\naddress = 1\ntype = \"int\"\n",
       "type = \"int\": expected one of \"int16\", \"uint16\", \"float32\""},
      {"[registers.temperature_actual]\naddress = 1\nwrite_function = 6\n",
       "write_function = 6: expected 16: a float32 takes two registers"},
      {"[registers.temperature_actual]\naddress = 1\nwrite_function = 7\n", "expected 6 or 16"},
      {"limit_min_c = 95\n" + registers, "limit_min_c = 95: expected less than limit_max_c, 90"},
  }));
  const auto profile = parse_chamber_profile(broken.text, "p.toml");
  REQUIRE_FALSE(profile.has_value());
  CHECK_THAT(profile.error().what, Catch::Contains(broken.message));
}
