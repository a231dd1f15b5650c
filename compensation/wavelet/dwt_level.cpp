#include "compensation/wavelet/dwt_level.h"

#include <algorithm>
#include <array>

#include "compensation/values/assert.h"
#include "compensation/wavelet/kernels.h"

namespace gyrocal {
namespace {

constexpr std::size_t edge_pairs_at_once = 16;

/// Outputs [begin, end) of which some see beyond an end of the signal. Output o starts at signal
/// index first + 2o.
void analyse_edge(std::span<const double> signal, const FilterBank& bank, Boundary boundary,
                  std::size_t begin, std::size_t end, std::span<double> low,
                  std::span<double> high) {
  const std::size_t half_taps = bank.taps() / 2;
  std::array<double, 2 * (edge_pairs_at_once + max_half_taps)> seen;
  while (begin < end) {
    const std::size_t count = std::min(end - begin, edge_pairs_at_once);
    const std::ptrdiff_t from =
        first_index(bank.taps(), boundary) + 2 * static_cast<std::ptrdiff_t>(begin);
    for (std::size_t i = 0; i < 2 * (count + half_taps - 1); ++i) {
      seen[i] = continued(signal, from + static_cast<std::ptrdiff_t>(i), boundary);
    }
    kernels().analyse(seen.data(), count, bank.rec_lo.data(), bank.rec_hi.data(), half_taps,
                      low.data() + begin, high.data() + begin);
    begin += count;
  }
}

}  // namespace

std::size_t band_length(std::size_t signal_length, std::size_t taps, Boundary boundary) {
  if (boundary == Boundary::periodization) return (signal_length + 1) / 2;
  return (signal_length + taps - 1) / 2;
}

std::ptrdiff_t first_index(std::size_t taps, Boundary boundary) {
  const auto length = static_cast<std::ptrdiff_t>(taps);
  return boundary == Boundary::periodization ? 1 - length / 2 : 2 - length;
}

void analyse_level(std::span<const double> signal, const FilterBank& bank, Boundary boundary,
                   std::span<double> low, std::span<double> high) {
  const std::size_t half_taps = bank.taps() / 2;
  GYROCAL_ASSERT(!signal.empty() && half_taps <= max_half_taps && low.size() == high.size());
  const std::ptrdiff_t first = first_index(bank.taps(), boundary);
  const std::size_t inside = std::min(low.size(), static_cast<std::size_t>((1 - first) / 2));
  const std::ptrdiff_t last_begin = std::ssize(signal) - static_cast<std::ptrdiff_t>(bank.taps());
  const std::ptrdiff_t fitting = last_begin < first ? 0 : (last_begin - first) / 2 + 1;
  const std::size_t outside = std::clamp(static_cast<std::size_t>(fitting), inside, low.size());
  analyse_edge(signal, bank, boundary, 0, inside, low, high);
  if (outside > inside) {
    // The correlation with rec_* is the convolution with dec_*.
    kernels().analyse(signal.data() + first + 2 * static_cast<std::ptrdiff_t>(inside),
                      outside - inside, bank.rec_lo.data(), bank.rec_hi.data(), half_taps,
                      low.data() + inside, high.data() + inside);
  }
  analyse_edge(signal, bank, boundary, outside, low.size(), low, high);
}

namespace {

/// The two bands going in and their filters; a missing band is a null `high`.
struct Bands {
  const double* low;
  const double* high;
  std::size_t length;
  const double* lo;
  const double* hi;
  std::size_t half_taps;
};

Bands bands_of(std::span<const double> low, std::span<const double> high, const FilterBank& bank) {
  const std::size_t half_taps = bank.taps() / 2;
  const double* const lo = bank.dec_lo.data();
  const double* const hi = bank.dec_hi.data();
  if (low.empty()) return {high.data(), nullptr, high.size(), hi, nullptr, half_taps};
  return {low.data(), high.empty() ? nullptr : high.data(), low.size(), lo, hi, half_taps};
}

/// Output pairs [begin, end) where the bands must be wrapped or an output falls outside the signal.
/// Pair p starts at signal index 2p - skip and at band index first_band + p.
void synthesise_edge(const Bands& bands, std::ptrdiff_t first_band, std::ptrdiff_t skip,
                     std::ptrdiff_t begin, std::ptrdiff_t end, std::span<double> signal) {
  std::array<double, edge_pairs_at_once + max_half_taps> low;
  std::array<double, edge_pairs_at_once + max_half_taps> high;
  std::array<double, 2 * edge_pairs_at_once> out;
  const std::span<const double> low_band(bands.low, bands.length);
  const std::span<const double> high_band(bands.high, bands.high ? bands.length : 0);
  while (begin < end) {
    const auto pairs = std::min(static_cast<std::size_t>(end - begin), edge_pairs_at_once);
    for (std::size_t i = 0; i < pairs + bands.half_taps - 1; ++i) {
      const std::ptrdiff_t at = first_band + begin + static_cast<std::ptrdiff_t>(i);
      low[i] = continued(low_band, at, Boundary::periodic);
      if (bands.high) high[i] = continued(high_band, at, Boundary::periodic);
    }
    kernels().synthesise(low.data(), bands.high ? high.data() : nullptr, pairs, bands.lo, bands.hi,
                         bands.half_taps, out.data());
    for (std::size_t i = 0; i < 2 * pairs; ++i) {
      const std::ptrdiff_t at = 2 * begin - skip + static_cast<std::ptrdiff_t>(i);
      if (at >= 0 && at < std::ssize(signal)) signal[static_cast<std::size_t>(at)] = out[i];
    }
    begin += static_cast<std::ptrdiff_t>(pairs);
  }
}

}  // namespace

void synthesise_level(std::span<const double> low, std::span<const double> high,
                      const FilterBank& bank, Boundary boundary, std::span<double> signal) {
  GYROCAL_ASSERT(low.size() == high.size() || low.empty() != high.empty());
  const Bands bands = bands_of(low, high, bank);
  const auto half_taps = static_cast<std::ptrdiff_t>(bands.half_taps);
  // Periodization centres the filter, so its outputs start half a filter earlier.
  const std::ptrdiff_t shift = boundary == Boundary::periodization ? half_taps - 1 : 0;
  const std::ptrdiff_t skip = shift % 2;
  const std::ptrdiff_t first_band = -((shift + 1) / 2);
  const std::ptrdiff_t pairs = (std::ssize(signal) + skip + 1) / 2;
  const std::ptrdiff_t inside = std::min(pairs, std::max(-first_band, skip));
  const std::ptrdiff_t outside =
      std::clamp(std::min(static_cast<std::ptrdiff_t>(bands.length) - half_taps + 1 - first_band,
                          (std::ssize(signal) + skip) / 2),
                 inside, pairs);
  synthesise_edge(bands, first_band, skip, 0, inside, signal);
  if (outside > inside) {
    kernels().synthesise(bands.low + first_band + inside,
                         bands.high ? bands.high + first_band + inside : nullptr,
                         static_cast<std::size_t>(outside - inside), bands.lo, bands.hi,
                         bands.half_taps, signal.data() + 2 * inside - skip);
  }
  synthesise_edge(bands, first_band, skip, outside, pairs, signal);
}

}  // namespace gyrocal
