#include "daemon/cli/command.h"
#include "daemon/cli/outcome.h"

int main(int argc, char** argv) {
  using namespace gyrocal::cli;
  CLI::App app{"gyrocal: calibrates the zero drift of MEMS gyroscopes over temperature"};
  app.require_subcommand(1);
  Chosen chosen;
  add_all_commands(app, chosen);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? exit_done : exit_bad_input;
  }
  return chosen ? chosen() : exit_done;
}
