#include "config/campaign_variant.h"

#include <catch2/catch.hpp>

using namespace gyrocal;

namespace {

CampaignConfig demo() {
  return read_campaign(GYROCAL_SOURCE_DIR "/config/campaigns/demo.toml").value();
}

}  // namespace

TEST_CASE("a variant changes visits, soak and name, and keeps the rest", "[config]") {
  const CampaignConfig before = demo();
  const std::string text =
      campaign_variant(before, {"again", "because", {{50}, {-10}, {50}}, 1260}).value();
  CHECK(text.starts_with("# because\n"));
  const CampaignConfig after =
      parse_campaign(text, GYROCAL_SOURCE_DIR "/config/campaigns/again.toml").value();
  CHECK(after.name == "again");
  CHECK(after.plan.sweep == Sweep::as_listed);
  REQUIRE(after.plan.setpoints.size() == 3);
  CHECK(after.plan.setpoints[0].value == 50);
  CHECK(after.plan.setpoints[1].value == -10);
  CHECK(after.stability.soak_s_min == 1260);
  CHECK(after.stability.soak_s_max >= 1260);
  CHECK(after.boards.size() == before.boards.size());
  CHECK(after.plan.samples_per_setpoint == before.plan.samples_per_setpoint);
  CHECK(after.time_scale == before.time_scale);
  CHECK(after.limits.chamber_stale_s == before.limits.chamber_stale_s);
}

TEST_CASE("a variant that would be refused as a campaign is refused here", "[config][bad input]") {
  CHECK_FALSE(campaign_variant(demo(), {"again", "because", {{500}}, 0}).has_value());
  CampaignConfig broken = demo();
  broken.text = "[campaign\n";
  CHECK(campaign_variant(broken, {"again", "because", {{20}}, 0}).error().code == Errc::bad_input);
}
