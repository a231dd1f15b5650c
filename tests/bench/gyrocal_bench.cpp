// gyrocal_bench [SECTION...]: one table, ours beside its peers.
// gyrocal_bench --growth: how the cost of each job grows with its size.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <fstream>
#include <string_view>

#include "compensation/wavelet/kernels.h"
#include "tests/bench/analyse_file.h"
#include "tests/bench/growth.h"
#include "tests/bench/sections.h"

namespace gyrocal::bench {
namespace {

struct Section {
  const char* name;
  Rows (*rows)();
};
constexpr std::array sections{
    Section{"wavelet", wavelet_rows},   Section{"fit", fit_rows},
    Section{"analysis", analysis_rows}, Section{"store", store_rows},
    Section{"codec", codec_rows},       Section{"acquisition", acquisition_rows},
    Section{"modbus", modbus_rows},     Section{"campaign", campaign_rows},
    Section{"query", query_rows},       Section{"diagnose", diagnose_rows},
    Section{"start", start_rows}};

std::string processor() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);) {
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  }
  return "unknown processor";
}

std::string widest_instruction_set() {
  if (kernels_for(InstructionSet::avx512) != nullptr) return "AVX-512";
  return kernels_for(InstructionSet::avx2) != nullptr ? "AVX2" : "portable";
}

void print_machine() {
  fmt::print("{} x {}; {} loops; gyrocal {}, built by g++ {} as {}\n",
             sysconf(_SC_NPROCESSORS_ONLN), processor(), widest_instruction_set(), GYROCAL_VERSION,
             __VERSION__, GYROCAL_BUILD_TYPE);
  double load = 0;
  getloadavg(&load, 1);
  fmt::print(
      "median [least, most]; CPU time (user and system) unless a row says wall; load {:.1f}\n\n",
      load);
}

bool is_wanted(const Section& section, int count, char** names) {
  return count < 2 || std::any_of(names + 1, names + count,
                                  [&](std::string_view name) { return name == section.name; });
}

bool is_known(std::string_view name) {
  return std::any_of(sections.begin(), sections.end(),
                     [&](const Section& section) { return name == section.name; });
}

int usage(const char* name) {
  fmt::print(stderr, "no section \"{}\"; there are:", name);
  for (const Section& section : sections) fmt::print(stderr, " {}", section.name);
  fmt::print(stderr, "\n");
  return 2;
}

int run(int count, char** names) {
  for (int i = 1; i < count; ++i) {
    if (!is_known(names[i])) return usage(names[i]);
  }
  print_machine();
  print_head();
  const double begin = wall_now_s();
  for (const Section& section : sections) {
    if (!is_wanted(section, count, names)) continue;
    for (const Row& row : section.rows()) print(row);
  }
  fmt::print("\n{:.0f} s in all\n", wall_now_s() - begin);
  return 0;
}

}  // namespace
}  // namespace gyrocal::bench

int main(int count, char** arguments) {
  using namespace gyrocal::bench;
  if (count == 3 && std::string_view(arguments[1]) == "--analyse")
    return analyse_file(arguments[2]);
  if (count == 2 && std::string_view(arguments[1]) == "--growth") {
    print_machine();
    return run_growth();
  }
  return run(count, arguments);
}
