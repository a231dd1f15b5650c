#include <fmt/core.h>

#include "daemon/cli/command.h"
#include "daemon/cli/mistyped.h"
#include "daemon/cli/outcome.h"
#include "gyrocal_version.h"

int main(int argc, char** argv) {
  using namespace gyrocal::cli;
  Command app{
      "Example: gyrocal run config/campaigns/demo.toml --virtual --seed 7 --db demo.db\n"
      "         gyrocal fit --db demo.db --board board0 --axis z\n"
      "         gyrocal COMMAND --help\n"
      "Calibrates the zero drift of MEMS gyroscopes over temperature.",
      "gyrocal"};
  app.add_version_flag("gyrocal " GYROCAL_VERSION);
  app.require_subcommand(1, 1);
  Chosen chosen;
  add_commands_for(argc > 1 ? argv[1] : "", app, chosen);
  switch (app.parse(argc, argv)) {
    case Parsed::helped:
      return exit_done;
    case Parsed::refused:
      if (const auto hint = mistyped(app, {argv + 1, argv + argc}); !hint.empty()) {
        fmt::print(stderr, "{}\n", hint);
      }
      return exit_bad_input;
    case Parsed::accepted:
      break;
  }
  return chosen ? chosen() : exit_done;
}
