#include <algorithm>
#include <string_view>

#include "daemon/cli/command.h"

namespace gyrocal::cli {
namespace {

struct Known {
  std::string_view name;
  AddCommand add;
  bool sees_all = false;  ///< its work is on the tree of all commands
};

/// In the order `--help` shows them.
constexpr Known known[] = {
    {"check", add_check},
    {"run", add_run},
    {"status", add_status},
    {"make-safe", add_make_safe},
    {"fit", add_fit},
    {"paper", add_paper},
    {"plan", add_plan},
    {"compensate", add_compensate},
    {"firmware", add_firmware},
    {"diagnose", add_diagnose},
    {"rig", add_rig},
    {"denoise", add_denoise},
    {"allan", add_allan},
    {"replay", add_replay},
    {"report", add_report},
    {"capsule", add_capsule},
    {"import", add_import},
    {"export", add_export},
    {"db", add_db},
    {"man", add_man, true},
    {"completion", add_completion, true},
    {"version", add_version},
};

}  // namespace

void add_all_commands(Command& root, Chosen& chosen) {
  for (const auto& each : known) each.add(root, chosen);
}

void add_commands_for(std::string_view first_word, Command& root, Chosen& chosen) {
  if (first_word == "--version") return;
  const auto* asked = std::find_if(std::begin(known), std::end(known), [&](const Known& each) {
    return each.name == first_word && !each.sees_all;
  });
  if (asked == std::end(known)) return add_all_commands(root, chosen);
  asked->add(root, chosen);
}

}  // namespace gyrocal::cli
