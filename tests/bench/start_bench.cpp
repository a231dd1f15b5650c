#include "tests/bench/child_process.h"
#include "tests/bench/sections.h"

namespace gyrocal::bench {

Rows start_rows() {
  std::vector<double> wall_s;
  std::vector<double> cpu_s;
  std::vector<double> true_cpu_s;
  for (int i = 0; i < 51; ++i) {  // by turns
    const auto ran = run_child({GYROCAL_PROGRAM, "--version"});
    const auto nothing = run_child({"true"});
    if (!ran || ran->exit_code != 0 || !nothing)
      return {failed("gyrocal --version", GYROCAL_PROGRAM)};
    wall_s.push_back(ran->wall_s);
    cpu_s.push_back(ran->cpu_s);
    true_cpu_s.push_back(nothing->cpu_s);
  }
  return {within("gyrocal --version, wall", spread_of(wall_s), 0.010, "a whole process"),
          against("the same, CPU", spread_of(cpu_s), {"/bin/true", spread_of(true_cpu_s), ""}, {},
                  "what any process costs here")};
}

}  // namespace gyrocal::bench
