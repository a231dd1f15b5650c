#include "daemon/cli/command_tree.h"

#include <algorithm>
#include <sstream>

namespace gyrocal::cli {
namespace {

std::string trimmed(const std::string& text) {
  const auto first = text.find_first_not_of(' ');
  return first == std::string::npos ? "" : text.substr(first);
}

}  // namespace

Described described(const std::string& description) {
  Described parts;
  std::istringstream lines(description);
  bool in_examples = true;
  for (std::string line; std::getline(lines, line);) {
    const bool marked = line.starts_with("Example: ") || line.starts_with("Examples: ");
    in_examples = in_examples && (marked || line.starts_with("   "));
    if (in_examples) {
      parts.examples.push_back(trimmed(marked ? line.substr(line.find(' ')) : line));
    } else {
      if (!parts.text.empty()) parts.text += ' ';
      parts.text += trimmed(line);
    }
  }
  return parts;
}

const Command* subcommand_named(const Command& command, const std::string& name) {
  for (const auto& each : command.subcommands()) {
    if (each->name() == name) return each.get();
  }
  return nullptr;
}

std::vector<std::string> subcommand_names(const Command& command) {
  std::vector<std::string> names;
  for (const auto& each : command.subcommands()) names.push_back(each->name());
  return names;
}

std::vector<std::string> path_of(const Command& command) {
  std::vector<std::string> words;
  for (const Command* at = &command; at->parent() != nullptr; at = at->parent()) {
    words.push_back(at->name());
  }
  words.emplace_back("gyrocal");
  std::reverse(words.begin(), words.end());
  return words;
}

std::vector<std::string> flags_of(const Option& option) {
  std::vector<std::string> flags;
  for (const auto& name : option.long_names()) flags.push_back("--" + name);
  for (const auto& name : option.short_names()) flags.push_back("-" + name);
  return flags;
}

std::vector<std::string> choices_of(const Option& option) {
  const auto type = option.type_name();  // "TEXT:{x,y,z}"
  const auto open = type.find('{');
  const auto close = type.find('}');
  if (open == std::string::npos || close == std::string::npos) return {};
  std::vector<std::string> choices;
  std::istringstream words(type.substr(open + 1, close - open - 1));
  for (std::string word; std::getline(words, word, ',');) choices.push_back(word);
  return choices;
}

}  // namespace gyrocal::cli
