#pragma once

#include <span>
#include <string>
#include <vector>

#include "compensation/discrepancy/diagnosis.h"

namespace gyrocal {

/// One axis of one board of a campaign, diagnosed by itself.
struct AxisDiagnosis {
  std::string board, axis;
  Diagnosis diagnosis;
};

/// Where an effect comes from, by who shows it: what all boards in the chamber show at once is the
/// environment's, what one board or one axis shows alone is the device's.
enum class Origin { environment, board, axis, unclear };
[[nodiscard]] std::string to_text(Origin origin);

/// An effect found somewhere, and who showed it.
struct SharedEffect {
  std::string effect;
  Origin origin = Origin::unclear;
  std::vector<std::string> seen_in;    ///< "board/axis"
  std::vector<std::string> absent_in;  ///< would have shown it at the smallest amplitude seen
  std::vector<std::string> blind_in;   ///< could not have shown it
  std::string sentence;
};

/// Effects of all diagnoses, the most shared first. Jumps are one effect only where their instants
/// agree to two minutes, sines only where their periods agree to a hundredth. `unknown` findings
/// are compared by their kind. With a single board nothing can be told about the environment.
/// Source: effects.md section 5 (3), issue 6 point 6.
[[nodiscard]] std::vector<SharedEffect> compare_boards(std::span<const AxisDiagnosis> diagnoses);

}  // namespace gyrocal
