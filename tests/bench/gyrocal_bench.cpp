#include <fmt/format.h>

#include <fstream>

#include "compensation/wavelet/kernels.h"
#include "tests/bench/bench_row.h"

namespace gyrocal::bench {
namespace {

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

std::string shown(double seconds) {
  if (seconds < 1e-3) return fmt::format("{:.2f} us", seconds * 1e6);
  return fmt::format("{:.2f} ms", seconds * 1e3);
}

void print(const Row& row) {
  const std::string peer = row.peer_s ? shown(*row.peer_s) : "-";
  const std::string ratio = row.peer_s ? fmt::format("{:.1f} x", *row.peer_s / row.ours_s) : "-";
  const std::string target = row.target_ratio ? fmt::format("{:.0f} x", *row.target_ratio) : "";
  fmt::print("{:<44}{:>11}  {:<11}{:>11}{:>9}{:>8}  {}\n", row.job, shown(row.ours_s), row.peer,
             peer, ratio, target, row.accuracy);
}

}  // namespace

std::optional<double> peer_seconds(const std::optional<PythonPeer>& python,
                                   const std::string& name) {
  if (!python) return std::nullopt;
  return python->seconds.at(name);
}

std::string difference_to(const std::optional<PythonPeer>& python, const std::string& name,
                          std::span<const double> ours) {
  if (!python) return "no peer";
  return fmt::format("differs by {:.1e}", largest_difference(ours, python->results.at(name)));
}

}  // namespace gyrocal::bench

int main(int count, char** arguments) {
  using namespace gyrocal::bench;
  if (count == 3 && std::string_view(arguments[1]) == "--analyse")
    return analyse_file(arguments[2]);
  Signals signals = wavelet_signals();
  signals.merge(fit_signals());
  fmt::print("{}; {} loops; CPU time, best of many; peers: ", processor(),
             widest_instruction_set());
  std::fflush(stdout);
  const auto python = run_python_peer(signals);
  fmt::print("{}, {}\n\n", gsl_name(),
             python ? python->versions
                    : "no Python with PyWavelets (apt install python3-pywt python3-numpy)");
  fmt::print("{:<44}{:>11}  {:<11}{:>11}{:>9}{:>8}  {}\n", "job", "gyrocal", "peer", "takes",
             "ratio", "target", "accuracy");
  for (const Row& row : wavelet_rows(signals, python)) print(row);
  for (const Row& row : fit_rows(signals, python)) print(row);
  for (const Row& row : analysis_rows(arguments[0])) print(row);
  return 0;
}
