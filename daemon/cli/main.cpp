#include <fmt/core.h>

#include "daemon/cli/command.h"
#include "daemon/cli/mistyped.h"
#include "daemon/cli/outcome.h"

int main(int argc, char** argv) {
  using namespace gyrocal::cli;
  CLI::App app{
      "Example: gyrocal run config/campaigns/demo.toml --virtual --seed 7 --db demo.db\n"
      "         gyrocal fit --db demo.db --board board0 --axis z\n"
      "         gyrocal COMMAND --help\n"
      "Calibrates the zero drift of MEMS gyroscopes over temperature.",
      "gyrocal"};
  app.require_subcommand(1);
  Chosen chosen;
  add_all_commands(app, chosen);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    const int code = app.exit(error) == 0 ? exit_done : exit_bad_input;
    const auto hint = code == exit_done ? "" : mistyped(app, {argv + 1, argv + argc});
    if (!hint.empty()) fmt::print(stderr, "{}\n", hint);
    return code;
  }
  return chosen ? chosen() : exit_done;
}
