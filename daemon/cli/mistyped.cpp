#include "daemon/cli/mistyped.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include "compensation/values/nearest_name.h"
#include "daemon/cli/command_tree.h"

namespace gyrocal::cli {
namespace {

std::string sentence(const char* what, const std::string& word, const CLI::App& command,
                     const std::vector<std::string>& known) {
  const auto near = nearest_name(word, std::vector<std::string_view>(known.begin(), known.end()));
  return fmt::format("{} has no {} \"{}\"{}", fmt::join(path_of(command), " "), what, word,
                     near.empty() ? "" : fmt::format("; is {} meant?", near));
}

bool has_positional(const CLI::App& command) {
  for (const CLI::Option* option : options(command)) {
    if (option->get_positional()) return true;
  }
  return false;
}

/// A word that is no command where one is due, or nearly one where a file may stand too.
std::string mistyped_command(const CLI::App& command, const std::string& word) {
  std::vector<std::string> known;
  for (const CLI::App* each : subcommands(command)) known.push_back(each->get_name());
  const auto near = nearest_name(word, std::vector<std::string_view>(known.begin(), known.end()));
  if (known.empty() || (near.empty() && has_positional(command))) return {};
  return sentence("command", word, command, known);
}

}  // namespace

std::string mistyped(const CLI::App& root, const std::vector<std::string>& words) {
  const CLI::App* at = &root;
  for (std::size_t i = 0; i < words.size(); ++i) {
    const auto& word = words[i];
    if (word == "--") return {};
    if (word.size() > 2 && word.starts_with("--")) {
      const auto name = word.substr(0, word.find('='));
      const CLI::Option* option = at->get_option_no_throw(name);
      if (option == nullptr) {
        std::vector<std::string> known;
        for (const CLI::Option* each : options(*at)) {
          for (const auto& flag : flags_of(*each)) known.push_back(flag);
        }
        return sentence("option", name, *at, known);
      }
      if (takes_value(*option) && name == word) ++i;  // what follows is its value
    } else if (const CLI::App* next = subcommand_named(*at, word)) {
      at = next;
    } else if (!word.starts_with('-')) {
      if (auto told = mistyped_command(*at, word); !told.empty()) return told;
    }
  }
  return {};
}

}  // namespace gyrocal::cli
