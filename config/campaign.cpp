#include "config/campaign.h"

#include <algorithm>

#include "config/campaign_checks.h"
#include "config/campaign_sections.h"
#include "config/setpoints.h"
#include "config/text_file.h"
#include "config/toml_section.h"

namespace gyrocal {

Result<CampaignConfig> parse_campaign(const std::string& text, const std::string& path,
                                      const std::optional<ChamberProfile>& profile) {
  auto file = TomlFile::parse(text, path);
  if (!file) return tl::unexpected(file.error());
  auto root = file->root();
  CampaignConfig campaign;
  campaign.text = text;
  CampaignSections sections(root);
  read_general(sections.general, path, campaign);
  read_plan(sections.plan, campaign.plan);
  if (const auto bad_profile = read_chamber(sections.chamber, path, profile, campaign.chamber)) {
    return tl::unexpected(*bad_profile);
  }
  read_boards(root, sections.boards, campaign.boards);
  read_stability(sections.stability, campaign.stability);
  read_limits(sections.limits, campaign.limits);
  read_analysis(sections.analysis, campaign.analysis);
  read_acceptance(sections.acceptance, campaign.acceptance);
  sections.refuse_unknown_keys();
  root.refuse_unknown_keys();
  // Values that stand for unread ones would only raise problems that are none.
  if (!file->problems()) check_together(sections, campaign);
  if (const auto problems = file->problems()) return tl::unexpected(*problems);
  campaign.plan.setpoints = in_visiting_order(std::move(campaign.plan.setpoints),
                                              campaign.plan.sweep, campaign.plan.shuffle_seed);
  return campaign;
}

Result<CampaignConfig> read_campaign(const std::string& path) {
  const auto text = read_text_file(path);
  if (!text) return tl::unexpected(text.error());
  return parse_campaign(*text, path);
}

SetpointRange allowed_setpoints(const CampaignConfig& campaign) {
  SetpointRange range{campaign.chamber.profile.limit_min, campaign.chamber.profile.limit_max};
  for (const BoardConfig& board : campaign.boards) {
    range.min = std::max(range.min, board.limit_min);
    range.max = std::min(range.max, board.limit_max);
  }
  return range;
}

}  // namespace gyrocal
