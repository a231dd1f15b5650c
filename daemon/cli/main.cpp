#include <fmt/core.h>

#include <string_view>

#include "daemon/cli/command.h"
#include "daemon/cli/mistyped.h"
#include "daemon/cli/outcome.h"

int main(int argc, char** argv) {
  using namespace gyrocal::cli;
  Command app{
      "Example: gyrocal run config/campaigns/demo.toml --virtual --seed 7 --db demo.db\n"
      "         gyrocal fit --db demo.db --board board0 --axis z\n"
      "         gyrocal COMMAND --help\n"
      "Calibrates the zero drift of MEMS gyroscopes over temperature.",
      "gyrocal"};
  app.require_subcommand(1, 1);
  Chosen chosen;
  add_all_commands(app, chosen);
  char version[] = "version";
  if (argc == 2 && std::string_view(argv[1]) == "--version") argv[1] = version;
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
