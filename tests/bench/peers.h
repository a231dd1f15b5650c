#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace gyrocal::bench {

/// What PyWavelets and NumPy took for the jobs of python_peer.py [s], and what they computed.
struct PythonPeer {
  std::string versions;  ///< "PyWavelets 1.1.1, NumPy 1.24.2"
  std::map<std::string, double> seconds;
  std::map<std::string, std::vector<double>> results;
};

/// Runs python_peer.py on the signals; absent if there is no Python with PyWavelets.
[[nodiscard]] std::optional<PythonPeer> run_python_peer(
    const std::map<std::string, std::vector<double>>& signals);

/// Time of GSL's full-depth db4 transform of 2^k samples [s]; absent if built without GSL.
[[nodiscard]] std::optional<double> gsl_transform_s(std::span<const double> signal);
[[nodiscard]] std::string gsl_name();

}  // namespace gyrocal::bench
