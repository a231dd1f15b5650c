#pragma once

#include <cmath>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "tests/bench/peers.h"

namespace gyrocal::bench {

/// One line of the table.
struct Row {
  std::string job;
  double ours_s;
  std::string peer;
  std::optional<double> peer_s;
  std::optional<double> target_ratio;
  std::string accuracy;
};

/// Jobs of python_peer.py: the part before the last underscore is the job, the rest tells them
/// apart.
using Signals = std::map<std::string, std::vector<double>>;

[[nodiscard]] inline double largest_difference(std::span<const double> a,
                                               std::span<const double> b) {
  if (a.size() != b.size()) return INFINITY;
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::abs(a[i] - b[i]));
  return largest;
}

[[nodiscard]] Signals wavelet_signals();
[[nodiscard]] std::vector<Row> wavelet_rows(const Signals& signals,
                                            const std::optional<PythonPeer>& python);
[[nodiscard]] Signals fit_signals();
[[nodiscard]] std::vector<Row> fit_rows(const Signals& signals,
                                        const std::optional<PythonPeer>& python);

/// A campaign from SQLite to stored models, whole processes compared.
[[nodiscard]] std::vector<Row> analysis_rows(const std::string& this_program);
/// What `this_program --analyse FILE` does. @return its exit code.
[[nodiscard]] int analyse_file(const std::string& path);

/// What the peer took for a job, and "differs by ...", if there is a peer.
[[nodiscard]] std::optional<double> peer_seconds(const std::optional<PythonPeer>& python,
                                                 const std::string& name);
[[nodiscard]] std::string difference_to(const std::optional<PythonPeer>& python,
                                        const std::string& name, std::span<const double> ours);

}  // namespace gyrocal::bench
