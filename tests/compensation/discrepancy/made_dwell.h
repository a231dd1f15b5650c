#pragma once

#include "compensation/discrepancy/dwell_data.h"

namespace gyrocal {

/// A dwell of `samples` at 50 Hz, half an hour after the one before.
/// @param sample_dps  called for each in turn.
template <class Sample>
DwellData made_dwell(int number, int samples, const Sample& sample_dps) {
  DwellData dwell;
  dwell.dwell = number;
  dwell.t_start_s = 1800.0 * number;
  for (int i = 0; i < samples; ++i) {
    dwell.y_dps.push_back(sample_dps());
    dwell.t_s.push_back(dwell.t_start_s + i / 50.0);
    dwell.seq.push_back(i);
    dwell.mean_dps += dwell.y_dps.back() / samples;
  }
  for (const double y : dwell.y_dps) dwell.residual_dps.push_back(y - dwell.mean_dps);
  return dwell;
}

}  // namespace gyrocal
