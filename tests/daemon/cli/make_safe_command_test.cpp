#include <catch2/catch.hpp>

#include "daemon/runner/owned_devices.h"
#include "tests/daemon/cli/run_gyrocal.h"
#include "tests/daemon/runner/served_rig.h"

namespace gyrocal {
namespace {

/// A database whose daemon took its hands off the chamber.
std::string hands_off_database(const runner::TemporaryFolder& folder) {
  const std::string path = folder / "off.db";
  auto store = Store::open(path);
  REQUIRE(store);
  CampaignRow row;
  row.name = "off";
  row.config_toml = "[campaign]";
  row.software_version = "test";
  row.utc_start_ns = 1;
  row.samples_per_setpoint = 1;
  row.sample_rate_hz = 50;
  row.monitor_interval_s = 5;
  row.state = "safe";
  const auto campaign = store->begin_campaign(row, {});
  REQUIRE(campaign);
  REQUIRE(store->add_event(*campaign, {1, 1, "error", "hands_off", "somebody else"}));
  return path;
}

}  // namespace

SCENARIO("make-safe writes the safe setpoint and reads it back, unless somebody else commands") {
  const runner::TemporaryFolder folder;
  const runner::ServedRig rig(folder);
  const std::string text = runner::campaign_text(folder, rig.port());
  const std::string campaign = folder.write("wired.toml", text);
  const auto config = parse_campaign(text, folder / "c.toml");
  REQUIRE(config);
  const auto owned = runner::wired_devices(*config);
  Chamber& chamber = owned->devices().chamber;
  REQUIRE(chamber.set_setpoint(Celsius{55}));

  const Ran refused = run_gyrocal("make-safe " + campaign + " --db " + hands_off_database(folder));
  CHECK(refused.exit_code == 0);
  CHECK(refused.err.find("somebody else commands the chamber") != std::string::npos);
  CHECK(chamber.read()->setpoint == Celsius{55});

  const Ran done = run_gyrocal("make-safe " + campaign + " --db " + (folder / "absent.db"));
  CHECK(done.exit_code == 0);
  CHECK(done.out.find("setpoint 25.0 degC, confirmed") != std::string::npos);
  CHECK(chamber.read()->setpoint == Celsius{25});
}

}  // namespace gyrocal
