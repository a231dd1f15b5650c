#include <fmt/format.h>

#include <random>

#include "compensation/wavelet/denoise.h"
#include "tests/bench/bench_row.h"
#include "tests/bench/stopwatch.h"

namespace gyrocal::bench {
namespace {

constexpr std::size_t dwells = 25;
constexpr std::size_t dwell_samples = 3000;

std::vector<double> noisy_dwell(std::size_t length) {
  std::mt19937 random(4);
  std::normal_distribution<double> normal(4.2, 1.31);
  std::vector<double> signal(length);
  for (double& x : signal) x = normal(random);
  return signal;
}

Row decompose_row(const std::string& name, const std::vector<double>& signal,
                  const std::optional<PythonPeer>& python) {
  const Wavelet wavelet{find_filter_bank("db4").value(), Boundary::symmetric, 5};
  Workspace workspace;
  Decomposition bands;
  const double ours = least_time_s([&] { decompose_into(signal, wavelet, workspace, bands); });
  return {fmt::format("decompose {} samples, db4, 5 levels", signal.size()),
          ours,
          "PyWavelets",
          peer_seconds(python, name),
          10,
          difference_to(python, name, bands.coefficients)};
}

/// As a caller without a workspace pays it: new memory each time, as PyWavelets takes it.
Row decompose_anew_row(const std::string& name, const std::vector<double>& signal,
                       const std::optional<PythonPeer>& python) {
  const Wavelet wavelet{find_filter_bank("db4").value(), Boundary::symmetric, 5};
  std::size_t count = 0;
  const double ours =
      least_time_s([&] { count += decompose(signal, wavelet).value().coefficients.size(); });
  return {fmt::format("the same {}, new memory each time", signal.size()),
          ours,
          "PyWavelets",
          peer_seconds(python, name),
          std::nullopt,
          count > 0 ? "as above" : "nothing computed"};
}

std::vector<Row> round_trip_rows(const std::string& name, const std::vector<double>& signal,
                                 const std::optional<PythonPeer>& python) {
  const Wavelet wavelet{find_filter_bank("db4").value(), Boundary::periodization,
                        deepest_level(signal.size())};
  Workspace workspace;
  Decomposition bands;
  std::vector<double> back;
  const double ours = least_time_s([&] {
    decompose_into(signal, wavelet, workspace, bands);
    reconstruct_into(bands, wavelet, workspace, back);
  });
  const std::string job = fmt::format("there and back {}, db4, all levels", signal.size());
  const std::string accuracy =
      fmt::format("comes back to {:.1e}", largest_difference(signal, back));
  return {{job, ours, "GSL", gsl_transform_s(signal), 5, accuracy},
          {job, ours, "PyWavelets", peer_seconds(python, name), std::nullopt, accuracy}};
}

Row denoise_row(const std::string& name, const std::vector<double>& signal,
                const std::optional<PythonPeer>& python) {
  DenoiseSettings settings = default_denoise_settings();
  settings.rule = Thresholding{Shrinkage::soft, ThresholdChoice::universal};
  Denoiser denoiser(settings);
  Denoised result;
  std::vector<double> all;
  bool done = true;
  const double ours = least_time_s([&] {
    all.clear();
    for (std::size_t dwell = 0; dwell < dwells; ++dwell) {
      const auto samples = std::span(signal).subspan(dwell * dwell_samples, dwell_samples);
      done = done && denoiser.run(samples, result).has_value();
      all.insert(all.end(), result.denoised.begin(), result.denoised.end());
    }
  });
  return {fmt::format("denoise {} dwells of {}, soft-universal", dwells, dwell_samples),
          ours,
          "PyWavelets",
          peer_seconds(python, name),
          10,
          done ? difference_to(python, name, all) : "failed"};
}

}  // namespace

Signals wavelet_signals() {
  return {{"decompose_3000", noisy_dwell(3000)},
          {"decompose_75000", noisy_dwell(75000)},
          {"decompose_10000000", noisy_dwell(10000000)},
          {"round_trip_4096", noisy_dwell(4096)},
          {"round_trip_65536", noisy_dwell(65536)},
          {"round_trip_1048576", noisy_dwell(1048576)},
          {"denoise_75000", noisy_dwell(dwells * dwell_samples)}};
}

std::vector<Row> wavelet_rows(const Signals& signals, const std::optional<PythonPeer>& python) {
  std::vector<Row> rows;
  for (const char* name : {"decompose_3000", "decompose_75000", "decompose_10000000"}) {
    rows.push_back(decompose_row(name, signals.at(name), python));
    rows.push_back(decompose_anew_row(name, signals.at(name), python));
  }
  for (const char* name : {"round_trip_4096", "round_trip_65536", "round_trip_1048576"}) {
    for (Row& row : round_trip_rows(name, signals.at(name), python)) rows.push_back(std::move(row));
  }
  rows.push_back(denoise_row("denoise_75000", signals.at("denoise_75000"), python));
  return rows;
}

}  // namespace gyrocal::bench
