#include "daemon/cli/database_choice.h"

#include <fmt/ranges.h>

#include "daemon/cli/one_of.h"

namespace gyrocal::cli {
namespace {

Result<CampaignId> choose_campaign(const Store& store, const DatabaseChoice& choice) {
  if (choice.campaign) return CampaignId{*choice.campaign};
  const auto latest = store.latest_campaign();
  if (!latest) return tl::unexpected(latest.error());
  if (*latest) return **latest;
  return fail(Errc::bad_input, choice.database + ": no campaign");
}

Result<Axis> choose_axis(const BoardRow& board, const DatabaseChoice& choice) {
  std::string measured;
  for (const Axis axis : all_axes) {
    if (board.measured.at(static_cast<std::size_t>(axis))) measured += letter(axis);
  }
  const bool unasked = choice.axis.empty();
  const char asked = !unasked ? choice.axis[0] : measured.size() == 1 ? measured[0] : 'z';
  if (measured.find(asked) == std::string::npos || choice.axis.size() > 1) {
    return fail(Errc::unknown_name,
                fmt::format("{}: board \"{}\" has no axis \"{}\"", choice.database, board.name,
                            unasked ? std::string(1, asked) : choice.axis),
                "its axes: " + measured);
  }
  return static_cast<Axis>(asked - 'x');
}

}  // namespace

void add_choice_options(Command& command, DatabaseChoice& choice) {
  command.add_option("--campaign", choice.campaign, "number of the campaign; default: the latest");
  command.add_option("--board", choice.board, "name of the board; default: the only one");
  command.add_option("--axis", choice.axis, "x, y or z; default: z, or the only one measured");
}

Result<ChosenBoard> choose_board(const Store& store, const DatabaseChoice& choice) {
  const auto campaign = choose_campaign(store, choice);
  if (!campaign) return tl::unexpected(campaign.error());
  if (const auto known = store.campaign(*campaign); !known) return tl::unexpected(known.error());
  const auto boards = store.boards(*campaign);
  if (!boards) return tl::unexpected(boards.error());
  std::vector<std::string> names;
  for (const auto& [id, row] : *boards) {
    names.push_back(row.name);
    if (row.name != choice.board && !(choice.board.empty() && boards->size() == 1)) continue;
    const auto axis = choose_axis(row, choice);
    if (!axis) return tl::unexpected(axis.error());
    return ChosenBoard{*campaign, id, row, *axis};
  }
  if (choice.board.empty()) {
    return fail(Errc::bad_input,
                fmt::format("{}: campaign {} has {} boards, --board says which", choice.database,
                            static_cast<std::int64_t>(*campaign), boards->size()),
                fmt::format("its boards: {}", fmt::join(names, ", ")));
  }
  return fail(Errc::unknown_name,
              fmt::format("{}: campaign {} has no board \"{}\"", choice.database,
                          static_cast<std::int64_t>(*campaign), choice.board),
              one_of(choice.board, "its boards", names));
}

}  // namespace gyrocal::cli
