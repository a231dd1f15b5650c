#pragma once

#include <optional>

#include "compensation/values/units.h"

namespace gyrocal::campaign {

/// Keeps readings no chamber can have meant away from every judgement: a lone 0.0 and jumps of more
/// than 20 K between readings, both seen on real ones (facts/chamber_modbus.md 1a). Five in a row
/// are believed.
class ReadingFilter {
 public:
  /// @return the reading, or nothing while it is doubtful; the caller treats that as missing.
  [[nodiscard]] std::optional<Celsius> pass(Celsius reading);
  /// Doubtful readings since the start.
  [[nodiscard]] int doubtful() const { return doubtful_; }

 private:
  std::optional<Celsius> last_;
  int in_a_row_ = 0;
  int doubtful_ = 0;
};

}  // namespace gyrocal::campaign
