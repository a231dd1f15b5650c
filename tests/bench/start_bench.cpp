#include "tests/bench/child_process.h"
#include "tests/bench/sections.h"

namespace gyrocal::bench {

Rows start_rows() {
  std::vector<double> wall_s;
  std::vector<double> cpu_s;
  for (int i = 0; i < 51; ++i) {
    const auto ran = run_child({GYROCAL_PROGRAM, "version"});
    if (!ran || ran->exit_code != 0) return {failed("gyrocal version", GYROCAL_PROGRAM)};
    wall_s.push_back(ran->wall_s);
    cpu_s.push_back(ran->cpu_s);
  }
  return {within("gyrocal version, wall", spread_of(wall_s), 0.010, "a whole process"),
          within("the same, CPU", spread_of(cpu_s), {}, "")};
}

}  // namespace gyrocal::bench
