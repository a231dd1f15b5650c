#pragma once

#include <optional>
#include <string>
#include <vector>

#include "config/campaign.h"
#include "config/toml_section.h"

namespace gyrocal {

/// The tables of a campaign file. One reader a table, below; each notes its problems in the file.
struct CampaignSections {
  explicit CampaignSections(TomlSection& root);
  void refuse_unknown_keys();

  TomlSection general;
  TomlSection plan;
  TomlSection chamber;
  TomlSection stability;
  TomlSection limits;
  TomlSection analysis;
  TomlSection acceptance;
  std::vector<TomlSection> boards;
};

void read_general(TomlSection& table, const std::string& path, CampaignConfig& into);
void read_plan(TomlSection& table, PlanConfig& into);  ///< setpoints as listed
/// @param profile  used instead of the one the table names, if given.
/// @return the problem of the chamber profile's own file, if it has one.
[[nodiscard]] std::optional<Error> read_chamber(TomlSection& table, const std::string& path,
                                                const std::optional<ChamberProfile>& profile,
                                                ChamberConfig& into);
void read_boards(TomlSection& root, std::vector<TomlSection>& tables,
                 std::vector<BoardConfig>& into);
void read_stability(TomlSection& table, StabilityConfig& into);
void read_limits(TomlSection& table, LimitConfig& into);
void read_analysis(TomlSection& table, AnalysisConfig& into);
void read_acceptance(TomlSection& table, AcceptanceConfig& into);

}  // namespace gyrocal
