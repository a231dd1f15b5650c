#include <fmt/core.h>

#include <memory>

#include "daemon/cli/command.h"
#include "daemon/cli/completion.h"
#include "daemon/cli/outcome.h"

namespace gyrocal::cli {

void add_completion(Command& root, Chosen& chosen) {
  auto* command = root.add_subcommand(
      "completion",
      "Example: gyrocal completion bash > ~/.local/share/bash-completion/completions/gyrocal\n"
      "Prints what a shell needs to complete commands and options; the Debian package installs "
      "it.");
  const auto shell = std::make_shared<std::string>();
  command->add_option("shell", *shell, "bash, zsh or fish")
      ->required()
      ->one_of({"bash", "zsh", "fish"});
  command->callback([shell, &root, &chosen] {
    chosen = [shell, &root] {
      fmt::print("{}", *shell == "bash"  ? bash_completion(root)
                       : *shell == "zsh" ? zsh_completion(root)
                                         : fish_completion(root));
      return exit_done;
    };
  });
}

}  // namespace gyrocal::cli
