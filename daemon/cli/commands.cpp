#include "daemon/cli/command.h"

namespace gyrocal::cli {

void add_all_commands(Command& root, Chosen& chosen) {
  constexpr AddCommand all[] = {
      add_check,    add_run,    add_status,     add_make_safe,                 //
      add_fit,      add_paper,  add_plan,       add_compensate, add_firmware,  //
      add_diagnose, add_rig,    add_denoise,    add_allan,                     //
      add_replay,   add_report, add_capsule,    add_import,     add_export,    //
      add_db,       add_man,    add_completion, add_version,                   //
  };
  for (const AddCommand add : all) add(root, chosen);
}

}  // namespace gyrocal::cli
