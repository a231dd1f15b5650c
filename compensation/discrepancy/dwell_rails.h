#pragma once

#include <span>
#include <vector>

#include "compensation/discrepancy/dwell_data.h"

namespace gyrocal {

/// One end of the range: nothing beyond the last code though much should be, and the rest piled up.
struct Rail {
  double nats = 0, at_dps = 0;
};

/// @param holes  whether codes are missing elsewhere: then the first one beyond may be one more.
[[nodiscard]] Rail find_rail(std::span<const DwellData> dwells, double lsb_dps, bool upper,
                             bool holes);

/// Whether a dwell's samples pile up at the first or the last code of the session, as on a rail: it
/// is no Gaussian and tells nothing of the codes beside.
struct AtAnEnd {
  bool piled = false;
  double white_sd_dps = 0;  ///< from what is not cut off; 0: too little is left
};

[[nodiscard]] std::vector<AtAnEnd> at_the_ends(std::span<const DwellData> dwells, double lsb_dps);

}  // namespace gyrocal
