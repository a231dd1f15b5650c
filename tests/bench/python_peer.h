#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "tests/bench/child_process.h"
#include "tests/bench/row.h"

namespace gyrocal::bench {

/// Runs tests/bench/SCRIPT by the first Python interpreter that has what it imports: Debian's
/// packages belong to Debian's interpreter, which need not be the first in the path. A script that
/// lacks a package ends with exit code 3.
[[nodiscard]] std::optional<ChildResult> run_python(const std::string& script,
                                                    const std::vector<std::string>& arguments);
/// The JSON such a script prints.
[[nodiscard]] std::optional<nlohmann::json> ask_python(const std::string& script,
                                                       const std::vector<std::string>& arguments);
/// [median, least, most] as peer_clock.py prints it.
[[nodiscard]] Spread spread_from(const nlohmann::json& three);

/// Jobs of signal_peer.py: the part before the last underscore is the job, the rest tells them
/// apart.
using Signals = std::map<std::string, std::vector<double>>;

/// What PyWavelets and NumPy took for these jobs, and what they computed.
class SignalPeer {
 public:
  explicit SignalPeer(const Signals& signals);
  [[nodiscard]] Peer pywavelets(const std::string& job) const;
  [[nodiscard]] Peer numpy(const std::string& job) const;
  /// "differs by 3.1e-15", if there is a peer.
  [[nodiscard]] std::string difference(const std::string& job, std::span<const double> ours) const;

 private:
  std::map<std::string, std::string> versions_;
  std::map<std::string, Spread> took_s_;
  std::map<std::string, std::vector<double>> results_;
};

[[nodiscard]] double largest_difference(std::span<const double> a, std::span<const double> b);

}  // namespace gyrocal::bench
