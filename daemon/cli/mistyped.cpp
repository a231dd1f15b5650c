#include "daemon/cli/mistyped.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include "compensation/values/nearest_name.h"
#include "daemon/cli/command_tree.h"

namespace gyrocal::cli {
namespace {

std::string sentence(const char* what, const std::string& word, const Command& command,
                     const std::vector<std::string>& known) {
  const auto near = nearest_name(word, std::vector<std::string_view>(known.begin(), known.end()));
  return fmt::format("{} has no {} \"{}\"{}", fmt::join(path_of(command), " "), what, word,
                     near.empty() ? "" : fmt::format("; is {} meant?", near));
}

bool has_positional(const Command& command) {
  for (const auto& option : command.options()) {
    if (option->is_positional()) return true;
  }
  return false;
}

/// nullptr: the command has none of that name.
const Option* option_named(const Command& command, const std::string& flag) {
  for (const auto& option : command.options()) {
    if (option->goes_by(flag)) return option.get();
  }
  return nullptr;
}

/// A word that is no command where one is due, or nearly one where a file may stand too.
std::string mistyped_command(const Command& command, const std::string& word) {
  std::vector<std::string> known;
  for (const auto& each : command.subcommands()) known.push_back(each->name());
  const auto near = nearest_name(word, std::vector<std::string_view>(known.begin(), known.end()));
  if (known.empty() || (near.empty() && has_positional(command))) return {};
  return sentence("command", word, command, known);
}

}  // namespace

std::string mistyped(const Command& root, const std::vector<std::string>& words) {
  const Command* at = &root;
  for (std::size_t i = 0; i < words.size(); ++i) {
    const auto& word = words[i];
    if (word == "--") return {};
    if (word.size() > 2 && word.starts_with("--")) {
      const auto name = word.substr(0, word.find('='));
      const Option* option = option_named(*at, name);
      if (option == nullptr) {
        std::vector<std::string> known;
        for (const auto& each : at->options()) {
          for (const auto& flag : flags_of(*each)) known.push_back(flag);
        }
        return sentence("option", name, *at, known);
      }
      if (option->takes_value() && name == word) ++i;  // what follows is its value
    } else if (const Command* next = subcommand_named(*at, word)) {
      at = next;
    } else if (!word.starts_with('-')) {
      if (auto told = mistyped_command(*at, word); !told.empty()) return told;
    }
  }
  return {};
}

}  // namespace gyrocal::cli
