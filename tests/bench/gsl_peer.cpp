#include "tests/bench/gsl_peer.h"

#include <gsl/gsl_version.h>
#include <gsl/gsl_wavelet.h>

#include <memory>

#include "tests/bench/measure.h"

namespace gyrocal::bench {
namespace {

struct Free {
  void operator()(gsl_wavelet* wavelet) const { gsl_wavelet_free(wavelet); }
  void operator()(gsl_wavelet_workspace* work) const { gsl_wavelet_workspace_free(work); }
};

}  // namespace

Peer gsl_round_trip(std::span<const double> signal) {
  constexpr std::size_t taps = 8;  // GSL counts taps: its Daubechies 8 is db4
  const std::unique_ptr<gsl_wavelet, Free> db4(gsl_wavelet_alloc(gsl_wavelet_daubechies, taps));
  const std::unique_ptr<gsl_wavelet_workspace, Free> work(
      gsl_wavelet_workspace_alloc(signal.size()));
  // It works in place; both ways, so that the data stay what they were.
  std::vector<double> data(signal.begin(), signal.end());
  const Spread took = time_of_call_s([&] {
    gsl_wavelet_transform_forward(db4.get(), data.data(), 1, data.size(), work.get());
    gsl_wavelet_transform_inverse(db4.get(), data.data(), 1, data.size(), work.get());
  });
  return {"GSL " GSL_VERSION, took, ""};
}

}  // namespace gyrocal::bench
