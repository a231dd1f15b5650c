#pragma once

#include "daemon/cli/command.h"

namespace gyrocal::cli {

/// The subcommands of `gyrocal rig`.
void add_rig_diff(Command& rig, Chosen& chosen);
void add_rig_serve(Command& rig, Chosen& chosen);
void add_rig_models(Command& rig, Chosen& chosen);
void add_rig_show(Command& rig, Chosen& chosen);
void add_rig_simulate(Command& rig, Chosen& chosen);

}  // namespace gyrocal::cli
