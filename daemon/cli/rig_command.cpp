#include "daemon/cli/rig_command.h"

namespace gyrocal::cli {

void add_rig(Command& root, Chosen& chosen) {
  auto* rig = root.add_subcommand("rig",
                                  "Example: gyrocal rig serve --boards 2 --time-scale 60\n"
                                  "The simulated chamber and boards, and what they are made of.");
  rig->require_subcommand(1, 1);
  constexpr AddCommand all[] = {add_rig_serve, add_rig_simulate, add_rig_models, add_rig_show,
                                add_rig_diff};
  for (const AddCommand add : all) add(*rig, chosen);
}

}  // namespace gyrocal::cli
