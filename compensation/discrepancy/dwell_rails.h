#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "compensation/discrepancy/dwell_data.h"

namespace gyrocal {

/// What of one dwell piles up in the last code, as on a rail: it is no Gaussian and tells nothing
/// of the codes beside.
struct Pile {
  double on = 0;            ///< samples in the last code
  bool wide = false;        ///< the others spread over codes enough that much should lie beyond
  double white_sd_dps = 0;  ///< from what is not cut off; 0: too little is left
};

/// One end of the codes that a session holds.
struct RangeEnd {
  double sign = 1;        ///< -1: the lower end
  std::int64_t code = 0;  ///< the last one, times `sign`
  double seen = 0;        ///< samples in it; 0: there is no last code
  double seen_beyond = 0;
  std::vector<std::optional<Pile>> piles;  ///< dwell by dwell
};

/// @param lsb_dps  0: values are no codes, and nothing piles up.
[[nodiscard]] RangeEnd range_end(std::span<const DwellData> dwells, double lsb_dps, bool upper);

/// Nothing beyond the last code though much should be, and the rest piled up.
struct Rail {
  double nats = 0, at_dps = 0;
};

/// @param end    of the same dwells.
/// @param holes  whether codes are missing elsewhere: then the first one beyond may be one more.
[[nodiscard]] Rail find_rail(std::span<const DwellData> dwells, const RangeEnd& end, double lsb_dps,
                             bool holes);

}  // namespace gyrocal
