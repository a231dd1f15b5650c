#include "daemon/cli/command_tree.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <functional>

#include "daemon/cli/command.h"
#include "daemon/cli/completion.h"
#include "daemon/cli/manual_page.h"
#include "daemon/cli/mistyped.h"

using namespace gyrocal::cli;

namespace {

struct Program {
  Command app{"Example: gyrocal fit --help\nCalibrates.", "gyrocal"};
  Chosen chosen;
  Program() { add_all_commands(app, chosen); }
};

void for_each_command(const Command& at, const std::function<void(const Command&)>& look) {
  look(at);
  for (const auto& each : at.subcommands()) for_each_command(*each, look);
}

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const auto& word : words) text += word + " ";
  return text;
}

}  // namespace

TEST_CASE("every command's help begins with an example of itself", "[cli]") {
  const Program program;
  int commands = 0;
  for_each_command(program.app, [&](const Command& command) {
    const auto parts = described(command.description());
    const auto path = joined(path_of(command));
    CAPTURE(path);
    REQUIRE_FALSE(parts.examples.empty());
    CHECK(parts.examples.front().find(path.substr(0, path.size() - 1)) != std::string::npos);
    CHECK((!parts.text.empty() || command.name() == "version"));
    ++commands;
  });
  CHECK(commands >= 30);
}

TEST_CASE("each command built alone is what it is among all", "[cli]") {
  const Program program;
  for (const auto& command : program.app.subcommands()) {
    CAPTURE(command->name());
    Command app{"Example: gyrocal fit --help\nCalibrates.", "gyrocal"};
    Chosen chosen;
    add_commands_for(command->name(), app, chosen);
    const auto& built = app.subcommands();
    const auto same = std::find_if(built.begin(), built.end(), [&](const auto& each) {
      return each->name() == command->name();
    });
    REQUIRE(same != built.end());
    CHECK(manual_page(**same, "1") == manual_page(*command, "1"));
  }
}

TEST_CASE("a word that is no command gets the tree of all, and a version none", "[cli]") {
  const auto commands_for = [](const char* word) {
    Command app{"Example: gyrocal fit --help\nCalibrates.", "gyrocal"};
    Chosen chosen;
    add_commands_for(word, app, chosen);
    return app.subcommands().size();
  };
  const std::size_t all = Program().app.subcommands().size();
  for (const char* word : {"", "--help", "fti", "pause", "man", "completion"}) {
    CHECK(commands_for(word) == all);
  }
  CHECK(commands_for("fit") == 1);
  CHECK(commands_for("--version") == 0);
}

TEST_CASE("a mistyped command or option gets the nearest one", "[cli]") {
  const Program program;
  const auto told = [&](std::vector<std::string> words) { return mistyped(program.app, words); };
  CHECK(told({"repaly", "x"}) == "gyrocal has no command \"repaly\"; is replay meant?");
  CHECK(told({"rig", "sevre"}) == "gyrocal rig has no command \"sevre\"; is serve meant?");
  CHECK(told({"db", "chekc", "a.db"}) == "gyrocal db has no command \"chekc\"; is check meant?");
  CHECK(told({"fit", "--bd", "x"}) == "gyrocal fit has no option \"--bd\"; is --db meant?");
  CHECK(told({"report", "--format", "hmtl"}) ==
        "gyrocal report has no format \"hmtl\"; is html meant?");
  CHECK(told({"report", "--format=svgg"}) ==
        "gyrocal report has no format \"svgg\"; is svg meant?");
  CHECK(told({"completion", "bahs"}) == "gyrocal completion has no shell \"bahs\"; is bash meant?");
  CHECK(told({"fit", "--axis", "yaw"}) == "gyrocal fit has no axis \"yaw\"");
  CHECK(told({"xyzzy"}) == "gyrocal has no command \"xyzzy\"");
  CHECK(told({"db", "campaign.db"}).empty());
  CHECK(told({"fit", "--db", "--bd"}).empty());  // the value of --db, however odd
  CHECK(told({"fit", "--db=x", "--axis", "z"}).empty());
}

TEST_CASE("each command and option but its last letter is told apart", "[cli][property]") {
  const Program program;
  for_each_command(program.app, [&](const Command& command) {
    auto words = path_of(command);
    words.erase(words.begin());
    for (const auto& option : command.options()) {
      for (const auto& name : option->long_names()) {
        if (name.size() < 5) continue;
        auto asked = words;
        asked.push_back("--" + name.substr(0, name.size() - 1));
        CAPTURE(joined(asked));
        CHECK(mistyped(program.app, asked).find("meant?") != std::string::npos);
      }
    }
  });
}

TEST_CASE("man pages hold every command and option", "[cli]") {
  const Program program;
  const auto pages = manual_pages(program.app, "0");
  const auto page = std::find_if(pages.begin(), pages.end(), [](const auto& named) {
    return named.first == "gyrocal-rig-serve.1";
  });
  REQUIRE(page != pages.end());
  CHECK(page->second.find(".SH NAME\ngyrocal\\-rig\\-serve \\- ") != std::string::npos);
  CHECK(page->second.find("\\-\\-time\\-scale") != std::string::npos);
  CHECK(page->second.find(".SH EXIT STATUS") != std::string::npos);
}

TEST_CASE("completion knows commands below commands and closed sets of values", "[cli]") {
  const Program program;
  const auto bash = bash_completion(program.app);
  CHECK(bash.find("'gyrocal rig') echo 'serve simulate models show diff --help' ;;") !=
        std::string::npos);
  CHECK(bash.find("'gyrocal fit --axis') echo 'x y z' ;;") != std::string::npos);
  CHECK(zsh_completion(program.app).starts_with("#compdef gyrocal\n"));
  CHECK(fish_completion(program.app).find("-l axis -x -a 'x y z'") != std::string::npos);
}
