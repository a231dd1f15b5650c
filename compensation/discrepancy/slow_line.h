#pragma once

#include <array>
#include <optional>
#include <vector>

#include "compensation/discrepancy/slow_search.h"

namespace gyrocal {

/// A sine in the slow stream.
struct SlowLine {
  double f_hz = 0;
  double amplitude_dps = 0, amplitude_sd_dps = 0;
  double nats = 0;  ///< with all noise free, the frequencies tried paid for
  double nats_same_noise = 0;
  std::array<std::vector<double>, 2> courses;  ///< cosine and sine at the track's instants
};

/// The strongest sine between a few turns a record and the bins' folding frequency, frequency and
/// noise refined together. Frequencies at which the chamber's own cycling stands are left to the
/// effects of temperature.
[[nodiscard]] std::optional<SlowLine> find_slow_line(const SlowModel& model);

}  // namespace gyrocal
