// gyrocald as systemd would run it: stopped, told about, told to.
#include <catch2/catch.hpp>

#include "daemon/runner/owned_devices.h"
#include "tests/daemon/runner/daemon_process.h"
#include "tests/daemon/runner/served_rig.h"

namespace gyrocal::runner {

SCENARIO(
    "systemd hears READY, STATUS and WATCHDOG; SIGTERM leaves a safe chamber, within its time") {
  const TemporaryFolder folder;
  const ServedRig rig(folder);
  const std::string campaign = folder.write("wired.toml", campaign_text(folder, rig.port()));
  NotifySocket unit(folder / "notify");
  Daemon daemon(campaign, folder / "wired.db", folder / "notify");
  CHECK(unit.hears("READY=1"));
  CHECK(unit.hears("STATUS=ramping"));
  CHECK(unit.hears("WATCHDOG=1"));
  daemon.signal(SIGTERM);
  CHECK(unit.hears("EXTEND_TIMEOUT_USEC="));
  CHECK(daemon.wait() == 3);

  const auto config = parse_campaign(campaign_text(folder, rig.port()), folder / "c.toml");
  REQUIRE(config);
  const auto owned = wired_devices(*config);
  CHECK(owned->devices().chamber.read()->setpoint == Celsius{25});
}

}  // namespace gyrocal::runner
