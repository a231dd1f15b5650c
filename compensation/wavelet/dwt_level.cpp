#include "compensation/wavelet/dwt_level.h"

#include <algorithm>
#include <array>

#include "compensation/values/assert.h"
#include "compensation/wavelet/kernels.h"

namespace gyrocal {
namespace {

constexpr std::size_t max_half_taps = 15;   // coif5
constexpr std::size_t block_outputs = 512;  // even and odd part of a block stay in the L1 cache
constexpr std::size_t edge_pairs_at_once = 16;

/// Writes the continued signal from index `begin` on, `pairs` even-odd pairs of it.
void split_continued(std::span<const double> signal, Boundary boundary, std::ptrdiff_t begin,
                     std::size_t pairs, double* even, double* odd) {
  const auto length = static_cast<std::ptrdiff_t>(signal.size());
  const auto count = static_cast<std::ptrdiff_t>(pairs);
  const std::ptrdiff_t inside = std::clamp<std::ptrdiff_t>((1 - begin) / 2, 0, count);
  const std::ptrdiff_t outside = std::clamp<std::ptrdiff_t>((length - begin) / 2, inside, count);
  const auto at_edge = [&](std::ptrdiff_t pair) {
    even[pair] = continued(signal, begin + 2 * pair, boundary);
    odd[pair] = continued(signal, begin + 2 * pair + 1, boundary);
  };
  for (std::ptrdiff_t pair = 0; pair < inside; ++pair) at_edge(pair);
  if (outside > inside) {
    kernels().split(signal.data() + begin + 2 * inside, static_cast<std::size_t>(outside - inside),
                    even + inside, odd + inside);
  }
  for (std::ptrdiff_t pair = outside; pair < count; ++pair) at_edge(pair);
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
  alignas(64) std::array<double, block_outputs + max_half_taps - 1> even;
  alignas(64) std::array<double, block_outputs + max_half_taps - 1> odd;
  for (std::size_t at = 0; at < low.size(); at += block_outputs) {
    const std::size_t count = std::min(block_outputs, low.size() - at);
    const std::ptrdiff_t begin =
        first_index(bank.taps(), boundary) + 2 * static_cast<std::ptrdiff_t>(at);
    split_continued(signal, boundary, begin, count + half_taps - 1, even.data(), odd.data());
    // The correlation with rec_* is the convolution with dec_*.
    kernels().analyse(even.data(), odd.data(), count, bank.rec_lo.data(), bank.rec_hi.data(),
                      half_taps, low.data() + at, high.data() + at);
  }
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
