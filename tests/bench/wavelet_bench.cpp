#include <fmt/format.h>

#include <random>

#include "compensation/wavelet/denoise.h"
#include "tests/bench/gsl_peer.h"
#include "tests/bench/measure.h"
#include "tests/bench/python_peer.h"
#include "tests/bench/sections.h"

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
                  const SignalPeer& peer) {
  const Wavelet wavelet{find_filter_bank("db4").value(), Boundary::symmetric, 5};
  Workspace workspace;
  Decomposition bands;
  const Spread ours = time_of_call_s([&] { decompose_into(signal, wavelet, workspace, bands); });
  return against(fmt::format("decompose {} samples, db4, 5 levels", signal.size()), ours,
                 peer.pywavelets(name), 10, peer.difference(name, bands.coefficients));
}

/// As a caller without a workspace pays it: new memory each time, as PyWavelets takes it.
Row decompose_anew_row(const std::string& name, const std::vector<double>& signal,
                       const SignalPeer& peer) {
  const Wavelet wavelet{find_filter_bank("db4").value(), Boundary::symmetric, 5};
  Decomposition bands;
  const Spread ours = time_of_call_s([&] { bands = decompose(signal, wavelet).value(); });
  return against(fmt::format("the same {}, new memory each time", signal.size()), ours,
                 peer.pywavelets(name), {}, peer.difference(name, bands.coefficients));
}

void add_round_trip_rows(const std::string& name, const std::vector<double>& signal,
                         const SignalPeer& peer, Rows& rows) {
  const Wavelet wavelet{find_filter_bank("db4").value(), Boundary::periodization,
                        deepest_level(signal.size())};
  Workspace workspace;
  Decomposition bands;
  std::vector<double> back;
  const Spread ours = time_of_call_s([&] {
    decompose_into(signal, wavelet, workspace, bands);
    reconstruct_into(bands, wavelet, workspace, back);
  });
  const std::string job = fmt::format("there and back {}, db4, all levels", signal.size());
  const std::string accuracy =
      fmt::format("comes back to {:.1e}", largest_difference(signal, back));
  rows.push_back(against(job, ours, gsl_round_trip(signal), 5, accuracy));
  rows.push_back(against(job, ours, peer.pywavelets(name), {}, accuracy));
}

Row denoise_row(const std::string& name, const std::vector<double>& signal,
                const SignalPeer& peer) {
  DenoiseSettings settings = default_denoise_settings();
  settings.rule = Thresholding{Shrinkage::soft, ThresholdChoice::universal};
  Denoiser denoiser(settings);
  Denoised result;
  std::vector<double> all;
  bool done = true;
  const Spread ours = time_of_call_s([&] {
    all.clear();
    for (std::size_t dwell = 0; dwell < dwells; ++dwell) {
      const auto samples = std::span(signal).subspan(dwell * dwell_samples, dwell_samples);
      done = done && denoiser.run(samples, result).has_value();
      all.insert(all.end(), result.denoised.begin(), result.denoised.end());
    }
  });
  const std::string job =
      fmt::format("denoise {} dwells of {}, soft-universal", dwells, dwell_samples);
  return done ? against(job, ours, peer.pywavelets(name), 10, peer.difference(name, all))
              : failed(job, "the denoiser refused the signal");
}

Signals signals() {
  return {{"decompose_3000", noisy_dwell(3000)},
          {"decompose_75000", noisy_dwell(75000)},
          {"decompose_10000000", noisy_dwell(10000000)},
          {"round_trip_4096", noisy_dwell(4096)},
          {"round_trip_65536", noisy_dwell(65536)},
          {"round_trip_1048576", noisy_dwell(1048576)},
          {"denoise_75000", noisy_dwell(dwells * dwell_samples)}};
}

}  // namespace

Rows wavelet_rows() {
  const Signals all = signals();
  const SignalPeer peer(all);
  Rows rows;
  for (const char* name : {"decompose_3000", "decompose_75000", "decompose_10000000"}) {
    rows.push_back(decompose_row(name, all.at(name), peer));
    rows.push_back(decompose_anew_row(name, all.at(name), peer));
  }
  for (const char* name : {"round_trip_4096", "round_trip_65536", "round_trip_1048576"}) {
    add_round_trip_rows(name, all.at(name), peer, rows);
  }
  rows.push_back(denoise_row("denoise_75000", all.at("denoise_75000"), peer));
  return rows;
}

}  // namespace gyrocal::bench
