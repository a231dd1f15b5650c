#pragma once

#include <optional>
#include <string>

#include "compensation/values/error.h"
#include "daemon/cli/command_line.h"
#include "schema/store.h"

namespace gyrocal::cli {

/// Which campaign, board and axis of a database a command is about.
struct DatabaseChoice {
  std::string database;
  std::optional<std::int64_t> campaign;  ///< default: the latest
  std::string board;                     ///< its name; default: the only one
  std::string axis;                      ///< default: z, or the only one measured
};

/// Adds --campaign, --board and --axis; --db is the command's own.
void add_choice_options(Command& command, DatabaseChoice& choice);

struct ChosenBoard {
  CampaignId campaign{};
  BoardId board{};
  BoardRow row;
  Axis axis = Axis::z;
};
/// @return unknown_name with the list of what is there; bad_input where the choice is not clear.
[[nodiscard]] Result<ChosenBoard> choose_board(const Store& store, const DatabaseChoice& choice);

}  // namespace gyrocal::cli
