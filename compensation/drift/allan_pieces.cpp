#include "compensation/drift/allan_pieces.h"

#include <cmath>

namespace gyrocal {

std::vector<std::vector<double>> unbroken_pieces(const std::vector<SessionSample>& samples,
                                                 std::optional<int> dwell) {
  std::vector<std::vector<double>> pieces;
  const SessionSample* before = nullptr;
  for (const SessionSample& sample : samples) {
    const bool wanted = !dwell || sample.dwell == *dwell;
    if (!wanted || std::isnan(sample.gyro_dps)) {
      before = nullptr;
      continue;
    }
    const bool follows =
        before != nullptr && before->dwell == sample.dwell && before->seq + 1 == sample.seq;
    if (!follows) pieces.emplace_back();
    pieces.back().push_back(sample.gyro_dps);
    before = &sample;
  }
  return pieces;
}

}  // namespace gyrocal
