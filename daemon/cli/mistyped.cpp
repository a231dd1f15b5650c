#include "daemon/cli/mistyped.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>

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
  const std::vector<std::string> known = subcommand_names(command);
  const auto near = nearest_name(word, std::vector<std::string_view>(known.begin(), known.end()));
  if (known.empty() || (near.empty() && has_positional(command))) return {};
  return sentence("command", word, command, known);
}

/// A word that is none of those the option takes.
std::string mistyped_value(const Command& command, const Option& option, const std::string& word) {
  const auto known = choices_of(option);
  if (known.empty() || std::find(known.begin(), known.end(), word) != known.end()) return {};
  const auto names = option.long_names();
  const auto name = names.empty() ? option.positional_name() : names.front();
  return sentence(name.c_str(), word, command, known);
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
      if (!option->takes_value()) continue;
      if (name == word) ++i;  // what follows is its value
      if (i == words.size()) return {};
      const auto value = name == word ? words[i] : word.substr(name.size() + 1);
      if (auto told = mistyped_value(*at, *option, value); !told.empty()) return told;
    } else if (const Command* next = subcommand_named(*at, word)) {
      at = next;
    } else if (!word.starts_with('-')) {
      if (auto told = mistyped_command(*at, word); !told.empty()) return told;
      for (const auto& option : at->options()) {
        if (!option->is_positional()) continue;
        if (auto told = mistyped_value(*at, *option, word); !told.empty()) return told;
      }
    }
  }
  return {};
}

}  // namespace gyrocal::cli
