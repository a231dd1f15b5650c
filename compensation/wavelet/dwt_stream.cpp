#include "compensation/wavelet/dwt_stream.h"

#include <algorithm>
#include <array>
#include <vector>

#include "compensation/values/assert.h"
#include "compensation/wavelet/dwt_level.h"
#include "compensation/wavelet/kernels.h"

namespace gyrocal {
namespace {

constexpr std::size_t long_signal = std::size_t{1} << 18;
constexpr std::size_t chunk = 2048;  // samples at a time
constexpr std::size_t max_taps = 30;

/// Samples at either end that decide all coefficients which see beyond it.
std::size_t end_length(std::size_t taps) {
  return (std::size_t{1} << streamed_levels) * (2 * taps + 4);
}

/// Between two levels: what the upper one gave and the lower one has not used yet.
struct Queue {
  std::array<double, chunk / 2 + 2 * max_taps> values;
  std::size_t held = 0;
  bool drop_first = false;

  double* room() { return values.data() + held; }
  void add(std::size_t count) {
    held += count;
    if (drop_first && held > 0) {
      drop(1);
      drop_first = false;
    }
  }
  void drop(std::size_t count) {
    held -= count;
    std::copy_n(values.data() + count, held, values.data());
  }
};

/// Where one level of the stream stands.
struct Level {
  std::span<double> details;
  std::size_t next_output;
  Queue input;  // unused in the first level, which reads the signal itself
};

/// All outputs that `held` values of input allow; the approximations go to `low`.
/// @param next  input to fetch meanwhile, or null.
/// @return how many; twice as many values of the input are used up.
std::size_t work(const FilterBank& bank, const double* input, std::size_t held, const double* next,
                 double* low, Level& level) {
  if (held < bank.taps()) return 0;
  const std::size_t half_taps = bank.taps() / 2;
  const std::size_t outputs = (held - bank.taps()) / 2 + 1;
  kernels().analyse_long(input, outputs, bank.rec_lo.data(), bank.rec_hi.data(), half_taps, low,
                         level.details.data() + level.next_output, next);
  level.next_output += outputs;
  return outputs;
}

/// The first output of each level that needs no value from beyond the left end.
std::vector<Level> levels_after_left_end(const FilterBank& bank, Boundary boundary,
                                         std::span<const std::span<double>> details) {
  const auto before = static_cast<std::size_t>(-first_index(bank.taps(), boundary));
  std::vector<Level> levels(details.size());
  std::size_t first_input = 0;
  for (std::size_t i = 0; i < levels.size(); ++i) {
    // Output o starts at input 2o - before.
    levels[i].details = details[i];
    levels[i].next_output = (first_input + before + 1) / 2;
    levels[i].input.drop_first = 2 * levels[i].next_output - before != first_input;
    first_input = levels[i].next_output;
  }
  return levels;
}

/// Everything that sees the signal only, not what lies beyond its ends.
void stream_inside(std::span<const double> signal, const FilterBank& bank,
                   std::vector<Level>& levels, std::span<double> low) {
  std::size_t used = levels[0].input.drop_first ? 1 : 0;
  for (std::size_t end = 0; end < signal.size();) {
    end = std::min(end + chunk, signal.size());
    const double* input = signal.data() + used;
    const double* next = end + chunk <= signal.size() ? signal.data() + end : nullptr;
    std::size_t held = end - used;
    for (std::size_t i = 0; i < levels.size(); ++i) {
      const bool last = i + 1 == levels.size();
      double* const to = last ? low.data() + levels[i].next_output : levels[i + 1].input.room();
      const std::size_t outputs = work(bank, input, held, next, to, levels[i]);
      if (i == 0) {
        used += 2 * outputs;
      } else {
        levels[i].input.drop(2 * outputs);
      }
      if (last) break;
      levels[i + 1].input.add(outputs);
      next = nullptr;
      input = levels[i + 1].input.values.data();
      held = levels[i + 1].input.held;
    }
  }
}

/// Outputs [0, begin) and [end, band.size()) of a band, from the band of the joined ends.
void copy_ends(std::span<const double> joined, std::size_t begin, std::size_t end,
               std::span<double> band) {
  std::copy_n(joined.begin(), begin, band.begin());
  std::copy_n(joined.end() - static_cast<std::ptrdiff_t>(band.size() - end), band.size() - end,
              band.begin() + static_cast<std::ptrdiff_t>(end));
}

}  // namespace

bool worth_streaming(std::size_t signal_length, std::size_t taps) {
  return signal_length >= std::max(long_signal, 4 * end_length(taps));
}

void stream_levels(std::span<const double> signal, const FilterBank& bank, Boundary boundary,
                   std::span<const std::span<double>> details, std::span<double> low) {
  GYROCAL_ASSERT(!details.empty() && details.size() <= streamed_levels &&
                 worth_streaming(signal.size(), bank.taps()));
  std::vector<Level> levels = levels_after_left_end(bank, boundary, details);
  std::vector<std::size_t> inside_begin;
  for (const Level& level : levels) inside_begin.push_back(level.next_output);
  stream_inside(signal, bank, levels, low);

  // A signal of the two ends alone, shorter by a multiple of 2^levels: its bands begin and end as
  // those of the whole do.
  const std::size_t end = end_length(bank.taps());
  const std::size_t step = std::size_t{1} << levels.size();
  const std::size_t left_out = (signal.size() - 2 * end) / step * step;
  std::vector<double> joined(signal.begin(), signal.begin() + static_cast<std::ptrdiff_t>(end));
  joined.insert(joined.end(), signal.begin() + static_cast<std::ptrdiff_t>(end + left_out),
                signal.end());
  for (std::size_t i = 0; i < levels.size(); ++i) {
    const std::size_t length = band_length(joined.size(), bank.taps(), boundary);
    std::vector<double> joined_low(length);
    std::vector<double> joined_high(length);
    analyse_level(joined, bank, boundary, joined_low, joined_high);
    copy_ends(joined_high, inside_begin[i], levels[i].next_output, details[i]);
    joined = std::move(joined_low);
  }
  copy_ends(joined, inside_begin.back(), levels.back().next_output, low);
}

}  // namespace gyrocal
