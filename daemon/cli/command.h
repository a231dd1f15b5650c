#pragma once

#include <CLI/CLI.hpp>
#include <functional>

namespace gyrocal::cli {

/// What the chosen subcommand will do, run after the whole command line has been parsed. Returns
/// the exit code (see outcome.h).
using Chosen = std::function<int()>;

/// Adds one subcommand to `root`; its callback puts what is to be done into `chosen`. Examples
/// stand first in the subcommand's description.
using AddCommand = void (*)(CLI::App& root, Chosen& chosen);

/// Every subcommand of `gyrocal`, in the order `--help` shows them.
void add_all_commands(CLI::App& root, Chosen& chosen);

void add_allan(CLI::App& root, Chosen& chosen);
void add_capsule(CLI::App& root, Chosen& chosen);
void add_check(CLI::App& root, Chosen& chosen);
void add_completion(CLI::App& root, Chosen& chosen);
void add_compensate(CLI::App& root, Chosen& chosen);
void add_db(CLI::App& root, Chosen& chosen);
void add_denoise(CLI::App& root, Chosen& chosen);
void add_diagnose(CLI::App& root, Chosen& chosen);
void add_export(CLI::App& root, Chosen& chosen);
void add_firmware(CLI::App& root, Chosen& chosen);
void add_fit(CLI::App& root, Chosen& chosen);
void add_import(CLI::App& root, Chosen& chosen);
void add_make_safe(CLI::App& root, Chosen& chosen);
void add_man(CLI::App& root, Chosen& chosen);
void add_paper(CLI::App& root, Chosen& chosen);
void add_plan(CLI::App& root, Chosen& chosen);
void add_replay(CLI::App& root, Chosen& chosen);
void add_report(CLI::App& root, Chosen& chosen);
void add_rig(CLI::App& root, Chosen& chosen);
void add_run(CLI::App& root, Chosen& chosen);
void add_status(CLI::App& root, Chosen& chosen);  ///< and pause, resume, skip, abort
void add_version(CLI::App& root, Chosen& chosen);

}  // namespace gyrocal::cli
