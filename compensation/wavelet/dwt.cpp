#include "compensation/wavelet/dwt.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <numeric>
#include <utility>

#include "compensation/values/assert.h"
#include "compensation/wavelet/dwt_level.h"
#include "compensation/wavelet/dwt_stream.h"

namespace gyrocal {
namespace {

/// Sizes `to` for the bands of n samples.
void lay_out(std::size_t signal_length, const Wavelet& wavelet, Decomposition& to) {
  const auto level = static_cast<std::size_t>(wavelet.level);
  to.lengths.assign(level + 2, signal_length);
  std::size_t length = signal_length;
  for (std::size_t down = 0; down < level; ++down) {
    length = band_length(length, wavelet.bank->taps(), wavelet.boundary);
    to.lengths[level - down] = length;
  }
  to.lengths[0] = length;
  to.coefficients.resize(std::accumulate(to.lengths.begin(), to.lengths.end() - 1, std::size_t{0}));
}

/// The half of the workspace not handed out last. Only grows: shrinking and growing again would
/// write zeros each time.
std::span<double> next_scratch(Workspace& workspace, std::size_t length) {
  std::swap(workspace.here, workspace.there);
  if (workspace.here.size() < length) workspace.here.resize(length);
  return std::span(workspace.here).first(length);
}

/// One level up at a time from band 0 to the signal. `keep` says which bands count; the others are
/// taken as zero.
template <class Keep>
void climb(const Decomposition& from, const Wavelet& wavelet, Workspace& workspace, Keep keep,
           std::vector<double>& signal) {
  GYROCAL_ASSERT(from.level() == wavelet.level);
  signal.resize(from.lengths.back());
  std::span<const double> low = keep(0) ? from.band(0) : std::span<const double>{};
  for (std::size_t band = 1; band < from.bands(); ++band) {
    const std::span<const double> high = keep(band) ? from.band(band) : std::span<const double>{};
    if (low.empty() && high.empty()) continue;
    std::span<double> up = signal;
    if (band + 1 < from.bands()) {
      up = next_scratch(workspace, from.lengths[band + 1]);
    }
    synthesise_level(low, high, *wavelet.bank, wavelet.boundary, up);
    low = up;
  }
}

}  // namespace

std::span<const double> Decomposition::band(std::size_t index) const {
  GYROCAL_ASSERT(index < bands());
  const auto before = static_cast<std::ptrdiff_t>(index);
  return std::span(coefficients)
      .subspan(std::accumulate(lengths.begin(), lengths.begin() + before, std::size_t{0}),
               lengths[index]);
}

std::span<double> Decomposition::band(std::size_t index) {
  const std::span<const double> found = std::as_const(*this).band(index);
  return std::span(coefficients)
      .subspan(static_cast<std::size_t>(found.data() - coefficients.data()), found.size());
}

int deepest_level(std::size_t signal_length) {
  return signal_length < 2 ? 0 : static_cast<int>(std::bit_width(signal_length)) - 1;
}

int useful_level(std::size_t signal_length, std::size_t taps) {
  return deepest_level(signal_length / (taps - 1));
}

Result<void> check_level(std::size_t signal_length, int level) {
  const int deepest = deepest_level(signal_length);
  if (deepest < 1) {
    return fail(Errc::too_few_points,
                fmt::format("a signal of {} samples cannot be decomposed", signal_length),
                "give at least 2 samples");
  }
  if (level < 1 || level > deepest) {
    return fail(Errc::out_of_range,
                fmt::format("level {} cannot be reached with {} samples", level, signal_length),
                fmt::format("choose a level from 1 to {}", deepest));
  }
  return {};
}

void decompose_into(std::span<const double> signal, const Wavelet& wavelet, Workspace& workspace,
                    Decomposition& to) {
  GYROCAL_ASSERT(wavelet.level >= 1 && wavelet.level <= deepest_level(signal.size()));
  lay_out(signal.size(), wavelet, to);
  std::span<const double> from = signal;
  std::size_t band = to.bands() - 1;
  if (worth_streaming(signal.size(), wavelet.bank->taps())) {
    std::array<std::span<double>, streamed_levels> details;
    const std::size_t levels = std::min(band, details.size());
    for (std::size_t i = 0; i < levels; ++i) details[i] = to.band(band - i);
    band -= levels;
    const std::span<double> low =
        band == 0 ? to.band(0) : next_scratch(workspace, to.lengths[band + 1]);
    stream_levels(signal, *wavelet.bank, wavelet.boundary, std::span(details).first(levels), low);
    from = low;
  }
  for (; band >= 1; --band) {
    const std::span<double> low =
        band == 1 ? to.band(0) : next_scratch(workspace, to.lengths[band]);
    analyse_level(from, *wavelet.bank, wavelet.boundary, low, to.band(band));
    from = low;
  }
}

Result<Decomposition> decompose(std::span<const double> signal, const Wavelet& wavelet) {
  if (const auto checked = check_level(signal.size(), wavelet.level); !checked) {
    return tl::unexpected(checked.error());
  }
  Workspace workspace;
  Decomposition to;
  decompose_into(signal, wavelet, workspace, to);
  return to;
}

void reconstruct_into(const Decomposition& from, const Wavelet& wavelet, Workspace& workspace,
                      std::vector<double>& signal) {
  climb(
      from, wavelet, workspace, [](std::size_t) { return true; }, signal);
}

std::vector<double> reconstruct(const Decomposition& from, const Wavelet& wavelet) {
  Workspace workspace;
  std::vector<double> signal;
  reconstruct_into(from, wavelet, workspace, signal);
  return signal;
}

std::vector<double> reconstruct_branch(const Decomposition& from, const Wavelet& wavelet,
                                       std::size_t band) {
  GYROCAL_ASSERT(band < from.bands());
  Workspace workspace;
  std::vector<double> signal;
  climb(
      from, wavelet, workspace, [band](std::size_t one) { return one == band; }, signal);
  return signal;
}

void reconstruct_approximation_into(const Decomposition& from, const Wavelet& wavelet,
                                    Workspace& workspace, std::vector<double>& signal) {
  climb(
      from, wavelet, workspace, [](std::size_t band) { return band == 0; }, signal);
}

}  // namespace gyrocal
