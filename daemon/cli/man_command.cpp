#include <fmt/core.h>

#include <filesystem>
#include <memory>

#include "daemon/cli/command.h"
#include "daemon/cli/command_tree.h"
#include "daemon/cli/manual_page.h"
#include "daemon/cli/one_of.h"
#include "daemon/cli/outcome.h"
#include "daemon/cli/text_output.h"
#include "gyrocal_version.h"

namespace gyrocal::cli {
namespace {

struct ManOptions {
  std::vector<std::string> words;
  std::string folder;
};

int write_all(const Command& root, const std::string& folder) {
  std::error_code failed;
  std::filesystem::create_directories(folder, failed);  // else writing says why not
  for (const auto& [name, text] : manual_pages(root, GYROCAL_VERSION)) {
    if (const auto written = write_text_file(folder + "/" + name, text); !written) {
      return report(written.error());
    }
  }
  return exit_done;
}

int print_one(const Command& root, const std::vector<std::string>& words) {
  const Command* at = &root;
  for (const auto& word : words) {
    const Command* const next = subcommand_named(*at, word);
    if (next == nullptr) {
      return report({Errc::unknown_name, fmt::format("no command is named \"{}\"", word),
                     one_of(word, "there are", subcommand_names(*at))});
    }
    at = next;
  }
  fmt::print("{}", manual_page(*at, GYROCAL_VERSION));
  return exit_done;
}

}  // namespace

void add_man(Command& root, Chosen& chosen) {
  auto* command = root.add_subcommand("man",
                                      "Example: gyrocal man fit | man -l -\n"
                                      "         gyrocal man --out man1\n"
                                      "Prints the man page of a command, or writes all of them.");
  const auto options = std::make_shared<ManOptions>();
  command->add_option("command", options->words, "the command's words; none: gyrocal itself");
  command->add_option("--out", options->folder, "folder for all pages");
  command->callback([options, &root, &chosen] {
    chosen = [options, &root] {
      return options->folder.empty() ? print_one(root, options->words)
                                     : write_all(root, options->folder);
    };
  });
}

}  // namespace gyrocal::cli
