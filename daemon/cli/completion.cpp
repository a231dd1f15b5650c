#include "daemon/cli/completion.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include "daemon/cli/command_tree.h"

namespace gyrocal::cli {
namespace {

/// "gyrocal rig serve", the key of every table below.
std::string key(const Command& command) {
  return fmt::format("{}", fmt::join(path_of(command), " "));
}

std::vector<const Command*> all_commands(const Command& root) {
  std::vector<const Command*> all{&root};
  for (const auto& each : root.subcommands()) {
    for (const Command* below : all_commands(*each)) all.push_back(below);
  }
  return all;
}

std::vector<std::string> long_flags(const Option& option) {
  std::vector<std::string> flags;
  for (const auto& name : option.long_names()) flags.push_back("--" + name);
  return flags;
}

/// What may follow a command: its commands, its options.
std::string words_after(const Command& command) {
  std::vector<std::string> words = subcommand_names(command);
  for (const auto& option : command.options()) {
    for (const auto& flag : long_flags(*option)) words.push_back(flag);
  }
  return fmt::format("{}", fmt::join(words, " "));
}

/// The shell functions both bash and zsh run: words after a command, values of an option ("file"
/// where any will do, empty for a flag).
std::string tables(const Command& root) {
  std::string words("_gyrocal_words() {\n  case \"$1\" in\n");
  std::string values("_gyrocal_values() {\n  case \"$1\" in\n");
  for (const Command* command : all_commands(root)) {
    words += fmt::format("    '{}') echo '{}' ;;\n", key(*command), words_after(*command));
    for (const auto& option : command->options()) {
      if (!option->takes_value() || option->is_positional()) continue;
      const auto choices = choices_of(*option);
      values += fmt::format("    '{} {}') echo '{}' ;;\n", key(*command),
                            fmt::join(flags_of(*option), fmt::format("'|'{} ", key(*command))),
                            choices.empty() ? "file" : fmt::format("{}", fmt::join(choices, " ")));
    }
  }
  return words + "  esac\n}\n" + values + "  esac\n}\n";
}

constexpr const char* walk = R"sh(# The command that the words so far name.
_gyrocal_command() {
  local at=gyrocal word
  for word in "$@"; do
    case " $(_gyrocal_words "$at") " in
      *" $word "*) case "$word" in -*) ;; *) at="$at $word" ;; esac ;;
    esac
  done
  echo "$at"
}
)sh";

constexpr const char* bash_end = R"sh(_gyrocal() {
  local current="${COMP_WORDS[COMP_CWORD]}" before="${COMP_WORDS[COMP_CWORD-1]}"
  local at values
  at="$(_gyrocal_command "${COMP_WORDS[@]:1:COMP_CWORD-1}")"
  values="$(_gyrocal_values "$at $before")"
  if [ "$values" = file ]; then
    COMPREPLY=($(compgen -f -- "$current"))
  elif [ -n "$values" ]; then
    COMPREPLY=($(compgen -W "$values" -- "$current"))
  else
    COMPREPLY=($(compgen -W "$(_gyrocal_words "$at")" -- "$current"))
    [ ${#COMPREPLY[@]} -gt 0 ] || COMPREPLY=($(compgen -f -- "$current"))
  fi
}
complete -o filenames -F _gyrocal gyrocal
)sh";

constexpr const char* zsh_end = R"sh(_gyrocal() {
  local at values
  at="$(_gyrocal_command "${(@)words[2,CURRENT-1]}")"
  values="$(_gyrocal_values "$at ${words[CURRENT-1]}")"
  if [[ "$values" == file ]]; then
    _files
  elif [[ -n "$values" ]]; then
    compadd -- ${=values}
  else
    compadd -- $(_gyrocal_words "$at")
    _files
  fi
}
_gyrocal "$@"
)sh";

std::string quoted(const std::string& text) {
  std::string out("'");
  for (const char c : text) {
    if (c == '\'' || c == '\\') out += '\\';
    out += c;
  }
  return out + "'";
}

/// When a fish rule holds: the words of the command were typed, none of its own commands yet.
std::string fish_condition(const Command& command) {
  std::string condition;
  const auto path = path_of(command);
  for (std::size_t i = 1; i < path.size(); ++i) {
    condition += fmt::format("__fish_seen_subcommand_from {}; and ", path[i]);
  }
  const std::vector<std::string> below = subcommand_names(command);
  return condition +
         (below.empty() ? "true"
                        : fmt::format("not __fish_seen_subcommand_from {}", fmt::join(below, " ")));
}

}  // namespace

std::string bash_completion(const Command& root) {
  return "# bash completion for gyrocal, written by gyrocal completion bash\n" + tables(root) +
         walk + bash_end;
}

std::string zsh_completion(const Command& root) {
  return "#compdef gyrocal\n# written by gyrocal completion zsh\n" + tables(root) + walk + zsh_end;
}

std::string fish_completion(const Command& root) {
  std::string text("# fish completion for gyrocal, written by gyrocal completion fish\n");
  for (const Command* command : all_commands(root)) {
    const auto rule = "complete -c gyrocal -n " + quoted(fish_condition(*command));
    for (const auto& each : command->subcommands()) {
      const auto parts = described(each->description());
      text += fmt::format("{} -f -a {} -d {}\n", rule, each->name(),
                          quoted(parts.text.substr(0, parts.text.find('.'))));
    }
    for (const auto& option : command->options()) {
      for (const auto& name : option->long_names()) {
        const auto choices = choices_of(*option);
        const auto value = !option->takes_value() ? std::string()
                           : choices.empty()
                               ? std::string(" -r")
                               : " -x -a " + quoted(fmt::format("{}", fmt::join(choices, " ")));
        text += fmt::format("{} -l {}{} -d {}\n", rule, name, value, quoted(option->description()));
      }
    }
  }
  return text;
}

}  // namespace gyrocal::cli
