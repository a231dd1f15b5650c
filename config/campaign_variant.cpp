#include "config/campaign_variant.h"

#include <fmt/core.h>
#include <toml++/toml.h>

#include <algorithm>
#include <sstream>

namespace gyrocal {

Result<std::string> campaign_variant(const CampaignConfig& campaign,
                                     const CampaignVariant& variant) {
  toml::table file;
  try {
    file = toml::parse(campaign.text);
  } catch (const toml::parse_error& error) {
    return fail(Errc::bad_input, fmt::format("the campaign file: {}", error.description()));
  }
  const auto table = [&file](const char* name) -> toml::table& {
    return *file.insert(name, toml::table()).first->second.as_table();
  };
  toml::table& general = table("campaign");
  general.insert_or_assign("name", variant.name);
  general.erase("database");
  toml::array setpoints;
  for (const Celsius visit : variant.visits) setpoints.push_back(visit.value);
  toml::table& plan = table("plan");
  plan.insert_or_assign("setpoints_c", std::move(setpoints));
  plan.insert_or_assign("sweep", "as_listed");
  plan.erase("shuffle_seed");
  if (variant.soak_s_min > 0) {
    toml::table& stability = table("stability");
    stability.insert_or_assign("soak_s_min", variant.soak_s_min);
    stability.insert_or_assign("soak_s_max",
                               std::max(campaign.stability.soak_s_max, 2 * variant.soak_s_min));
  }
  std::ostringstream text;
  text << "# " << variant.reason << "\n\n" << file << "\n";
  if (const auto read =
          parse_campaign(text.str(), variant.name + ".toml", campaign.chamber.profile);
      !read) {
    return tl::unexpected(read.error());
  }
  return text.str();
}

}  // namespace gyrocal
