#pragma once

#include <functional>
#include <string_view>

#include "daemon/cli/command_line.h"

namespace gyrocal::cli {

/// What the chosen subcommand will do, run after the whole command line has been parsed. Returns
/// the exit code (see outcome.h).
using Chosen = std::function<int()>;

/// Adds one subcommand to `root`; its callback puts what is to be done into `chosen`. Examples
/// stand first in the subcommand's description.
using AddCommand = void (*)(Command& root, Chosen& chosen);

/// Every subcommand of `gyrocal`, in the order `--help` shows them.
void add_all_commands(Command& root, Chosen& chosen);

/// What this first word of a command line needs: one subcommand where it names one, since building
/// the tree of all is a tenth of the program's start; else all, for help and hints.
void add_commands_for(std::string_view first_word, Command& root, Chosen& chosen);

void add_allan(Command& root, Chosen& chosen);
void add_capsule(Command& root, Chosen& chosen);
void add_check(Command& root, Chosen& chosen);
void add_completion(Command& root, Chosen& chosen);
void add_compensate(Command& root, Chosen& chosen);
void add_db(Command& root, Chosen& chosen);
void add_denoise(Command& root, Chosen& chosen);
void add_diagnose(Command& root, Chosen& chosen);
void add_export(Command& root, Chosen& chosen);
void add_firmware(Command& root, Chosen& chosen);
void add_fit(Command& root, Chosen& chosen);
void add_import(Command& root, Chosen& chosen);
void add_make_safe(Command& root, Chosen& chosen);
void add_man(Command& root, Chosen& chosen);
void add_paper(Command& root, Chosen& chosen);
void add_plan(Command& root, Chosen& chosen);
void add_replay(Command& root, Chosen& chosen);
void add_report(Command& root, Chosen& chosen);
void add_rig(Command& root, Chosen& chosen);
void add_run(Command& root, Chosen& chosen);
void add_status(Command& root, Chosen& chosen);  ///< and pause, resume, skip, abort
void add_version(Command& root, Chosen& chosen);

}  // namespace gyrocal::cli
