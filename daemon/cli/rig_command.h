#pragma once

#include "daemon/cli/command.h"

namespace gyrocal::cli {

/// The subcommands of `gyrocal rig`.
void add_rig_diff(CLI::App& rig, Chosen& chosen);
void add_rig_serve(CLI::App& rig, Chosen& chosen);
void add_rig_models(CLI::App& rig, Chosen& chosen);
void add_rig_show(CLI::App& rig, Chosen& chosen);
void add_rig_simulate(CLI::App& rig, Chosen& chosen);

}  // namespace gyrocal::cli
