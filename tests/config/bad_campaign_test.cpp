// What a person sees who mistypes a campaign file: file, line, key, what stands there, what was
// expected.
#include <catch2/catch.hpp>
#include <string>
#include <vector>

#include "config/campaign.h"

using namespace gyrocal;

namespace {

/// A sound campaign in which `line` stands alone on line 2 of its table.
struct Broken {
  std::string table;
  std::string line;
  Errc code;
  std::string message;
};

std::string campaign_with(const Broken& broken) {
  std::string text;
  const auto add = [&](const std::string& table, const std::string& lines) {
    text += (table == "board" ? "[[board]]" : "[" + table + "]") + "\n" +
            (broken.table == table ? broken.line + "\n" : "") + lines;
  };
  add("campaign",
      broken.line.rfind("name", 0) == 0 && broken.table == "campaign" ? "" : "name = \"small\"\n");
  add("plan", "");
  add("chamber", broken.line.rfind("host", 0) == 0 ? "profile = \"yinhe\"\n"
                 : broken.line.rfind("profile", 0) == 0
                     ? "host = \"192.0.2.5\"\n"
                     : "profile = \"yinhe\"\nhost = \"192.0.2.5\"\n");
  add("stability", "");
  add("limits", "");
  add("analysis", "");
  text += "[[board]]\nname = \"first\"\ndevice = \"/dev/first\"\n";
  add("board", broken.line.rfind("name", 0) == 0 ? "device = \"/dev/second\"\n"
               : broken.line.rfind("device", 0) == 0
                   ? "name = \"second\"\n"
                   : "name = \"second\"\ndevice = \"/dev/second\"\n");
  return text;
}

}  // namespace

TEST_CASE("each mistake in a campaign file is named with its place and its cure", "[config][bad]") {
  const auto broken = GENERATE(values<Broken>({
      {"plan", "setpoint_c = [1]", Errc::unknown_name,
       "c.toml:4: unknown key plan.setpoint_c = an array of 1: did you mean \"setpoints_c\"?"},
      {"campaign", "colour = 1", Errc::unknown_name,
       "c.toml:2: unknown key campaign.colour = 1: known here: name, simulated, time_scale, "
       "database"},
      {"plan", "sample_rate_hz = \"50\"", Errc::bad_input,
       "c.toml:4: plan.sample_rate_hz = \"50\": expected a whole number from 1 to 400 [Hz]"},
      {"plan", "sample_rate_hz = 60", Errc::out_of_range,
       "c.toml:4: plan.sample_rate_hz = 60: expected a rate the iNEMO firmware knows: 1, 10, 25, "
       "30, 50, 100 or 400 [Hz]"},
      {"plan", "samples_per_setpoint = 0", Errc::out_of_range,
       "c.toml:4: plan.samples_per_setpoint = 0: expected a whole number from 1 to 10000000"},
      {"plan", "samples_per_setpoint = 30.5", Errc::bad_input,
       "c.toml:4: plan.samples_per_setpoint = 30.5: expected a whole number from 1 to 10000000"},
      {"plan", "safe_setpoint_c = nan", Errc::not_finite,
       "c.toml:4: plan.safe_setpoint_c = nan: expected a finite number from -273.15 to 1000 "
       "[degC]"},
      {"plan", "setpoints_c = [10, nan]", Errc::not_finite,
       "c.toml:4: plan.setpoints_c[1] = nan: expected a finite number from -273.15 to 1000 [degC]"},
      {"plan", "setpoints_c = [10, inf]", Errc::not_finite, "plan.setpoints_c[1] = inf"},
      {"plan", "setpoints_c = [10, \"20\"]", Errc::bad_input,
       "c.toml:4: plan.setpoints_c[1] = \"20\": expected a number from -273.15 to 1000 [degC]"},
      {"plan", "setpoints_c = []", Errc::bad_input, "plan.setpoints_c = an array of 0: expected"},
      {"plan", "setpoints_c = 20", Errc::bad_input, "plan.setpoints_c = 20: expected an array of"},
      {"plan", "setpoints_c = [20, 95]", Errc::out_of_range,
       "c.toml:4: plan.setpoints_c = an array of 2: expected setpoints from -20 (board \"second\") "
       "to 70 (board \"second\") [degC], not 95"},
      {"plan", "setpoints_c = [20, 30, 20]", Errc::bad_input,
       "expected 20 once in this sweep; sweep = \"as_listed\" allows revisits"},
      {"plan", "safe_setpoint_c = -30", Errc::out_of_range, "expected a setpoint from -20"},
      {"plan", "sweep = \"suffled\"", Errc::unknown_name,
       "c.toml:4: plan.sweep = \"suffled\": expected one of \"up\", \"up_down\", \"shuffled\", "
       "\"as_listed\"; did you mean \"shuffled\"?"},
      {"campaign", "time_scale = 400", Errc::bad_input,
       "c.toml:2: campaign.time_scale = 400: expected 1: only simulated devices can run faster "
       "(simulated = true)"},
      {"campaign", "simulated = 1", Errc::bad_input,
       "c.toml:2: campaign.simulated = 1: expected true or false"},
      {"campaign", "name = \"\"", Errc::bad_input,
       "c.toml:2: campaign.name = \"\": expected a name"},
      {"campaign", "name = \"a/b\"", Errc::bad_input, "a name without slashes"},
      {"chamber", "host = \"chamber.local\"", Errc::bad_input,
       "c.toml:5: chamber.host = \"chamber.local\": expected a numeric address, 192.0.2.5: no name "
       "server is asked"},
      {"chamber", "port = 70000", Errc::out_of_range,
       "c.toml:5: chamber.port = 70000: expected a whole number from 1 to 65535"},
      {"chamber", "device = \"/dev/ttyS0\"", Errc::bad_input,
       "expected host (Modbus TCP) or device (Modbus RTU), not both"},
      {"chamber", "baud = 9600", Errc::unknown_name, "unknown key chamber.baud = 9600"},
      {"chamber", "profile = \"yinhee\"", Errc::unknown_name,
       "c.toml:5: chamber.profile = \"yinhee\": expected the name of a profile in ."},
      {"chamber", "profile = \"yinhee\"", Errc::unknown_name, "; is \"yinhe\" meant?"},
      {"chamber", "poll_interval_s = 40", Errc::out_of_range, "every reading would be stale"},
      {"board", "device = \"/dev/first\"", Errc::bad_input,
       "c.toml:14: board[1].device = \"/dev/first\": expected a device of its own; board \"first\" "
       "has it already"},
      {"board", "name = \"first\"", Errc::bad_input,
       "c.toml:14: board[1].name = \"first\": expected a name unique in this campaign; board[0] "
       "has "
       "it already"},
      {"board", "mcu_id = \"xyz\"", Errc::bad_input, "board[1].mcu_id = \"xyz\": expected 24 hex"},
      {"board", "lsb_per_dps = [4.13]", Errc::bad_input, "expected three numbers, for X, Y and Z"},
      {"board", "lsb_per_dps = [4.13, 0, 4.13]", Errc::out_of_range, "board[1].lsb_per_dps[1] = 0"},
      {"board", "limit_min_c = 80", Errc::out_of_range,
       "c.toml:14: board[1].limit_min_c = 80: expected less than limit_max_c, 70"},
      {"stability", "soak_s_min = 9000", Errc::out_of_range,
       "expected at most soak_s_max, 7200 s: it could never be met"},
      {"limits", "dwell_band_k = 0.1", Errc::out_of_range, "every dwell would be rejected"},
      {"limits", "dwell_attempts_max = true", Errc::bad_input, "limits.dwell_attempts_max = true"},
      {"analysis", "level = 0", Errc::out_of_range, "analysis.level = 0: expected a whole number"},
      {"analysis", "wavelet = \"db44\"", Errc::unknown_name,
       "analysis.wavelet = \"db44\": expected one of the known wavelets: haar"},
      {"analysis", "mode = \"mirror\"", Errc::unknown_name, "expected one of the known modes:"},
      {"analysis", "mode = \"symetric\"", Errc::unknown_name, "; is symmetric meant?"},
      {"analysis", "wavelet = \"dbb4\"", Errc::unknown_name, "; is db4 meant?"},
      {"analysis", "rule = \"soft-baye\"", Errc::unknown_name, "; is soft-bayes meant?"},
      {"analysis", "rule = \"softer\"", Errc::unknown_name, "expected one of the known rules:"},
      {"plan", "samples_per_setpoint = 20", Errc::out_of_range,
       "analysis.level is missing: expected at most 4: a dwell has 20 samples"},
      {"plan", "sweep = \"up", Errc::bad_input, "c.toml:4:12: not TOML: "},
      {"plan", "sweep = \"up\"\nsweep = \"up\"", Errc::bad_input, "c.toml:5:"},
  }));
  const auto campaign = parse_campaign(campaign_with(broken), "c.toml");
  CAPTURE(broken.line);
  REQUIRE_FALSE(campaign.has_value());
  CHECK_THAT(campaign.error().what, Catch::Contains(broken.message));
  CHECK(campaign.error().code == broken.code);
}

TEST_CASE("the campaign the mistakes are put into is sound itself", "[config][bad]") {
  const auto campaign = parse_campaign(campaign_with({}), "c.toml");
  if (!campaign) FAIL(campaign.error().what);
  CHECK(campaign->boards.size() == 2);
}

TEST_CASE("several mistakes are told at once, in the order of the file", "[config][bad]") {
  const auto campaign =
      parse_campaign("[limits]\nfoo = 1\n[plan]\nsample_rate_hz = nan\n", "c.toml");
  REQUIRE_FALSE(campaign.has_value());
  const auto& what = campaign.error().what;
  CHECK_THAT(what, Catch::Contains("campaign.name is missing"));
  CHECK_THAT(what, Catch::Contains("board is missing: expected at least one [[board]]"));
  CHECK_THAT(what,
             Catch::Contains("chamber.host is missing: expected host (Modbus TCP) or device"));
  CHECK(what.find("c.toml:2: unknown key limits.foo") < what.find("c.toml:4: plan.sample_rate_hz"));
}

TEST_CASE("a campaign file that cannot be read is named with the reason", "[config][bad]") {
  const auto missing = read_campaign("/nowhere/c.toml");
  REQUIRE_FALSE(missing.has_value());
  CHECK(missing.error() == Error{Errc::bad_input, "read /nowhere/c.toml: No such file or directory",
                                 "check the path"});
  const auto folder = read_campaign("/tmp");
  REQUIRE_FALSE(folder.has_value());
  CHECK(folder.error().what == "read /tmp: Is a directory");
}
