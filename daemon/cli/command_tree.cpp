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
      parts.text += (parts.text.empty() ? "" : " ") + trimmed(line);
    }
  }
  return parts;
}

std::vector<const CLI::App*> subcommands(const CLI::App& command) {
  return command.get_subcommands([](const CLI::App*) { return true; });
}

const CLI::App* subcommand_named(const CLI::App& command, const std::string& name) {
  for (const CLI::App* each : subcommands(command)) {
    if (each->get_name() == name) return each;
  }
  return nullptr;
}

std::vector<const CLI::Option*> options(const CLI::App& command) {
  return command.get_options([](const CLI::Option*) { return true; });
}

std::vector<std::string> path_of(const CLI::App& command) {
  std::vector<std::string> words;
  for (const CLI::App* at = &command; at->get_parent() != nullptr; at = at->get_parent()) {
    words.push_back(at->get_name());
  }
  words.emplace_back("gyrocal");
  std::reverse(words.begin(), words.end());
  return words;
}

std::vector<std::string> flags_of(const CLI::Option& option) {
  std::vector<std::string> flags;
  for (const auto& name : option.get_lnames()) flags.push_back("--" + name);
  for (const auto& name : option.get_snames()) flags.push_back("-" + name);
  return flags;
}

bool takes_value(const CLI::Option& option) { return option.get_items_expected_max() > 0; }

std::vector<std::string> choices_of(const CLI::Option& option) {
  const auto type = option.get_type_name();  // "TEXT:{x,y,z}"
  const auto open = type.find('{');
  const auto close = type.find('}');
  if (open == std::string::npos || close == std::string::npos) return {};
  std::vector<std::string> choices;
  std::istringstream words(type.substr(open + 1, close - open - 1));
  for (std::string word; std::getline(words, word, ',');) choices.push_back(word);
  return choices;
}

}  // namespace gyrocal::cli
