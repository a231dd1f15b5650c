#pragma once

#include <span>
#include <string>
#include <vector>

#include "compensation/discrepancy/diagnosis.h"
#include "compensation/discrepancy/dwell_codes.h"
#include "compensation/discrepancy/dwell_colour.h"
#include "compensation/discrepancy/dwell_spectrum.h"

namespace gyrocal {

/// What the samples of the dwells say, whatever the slow stream does.
struct FastEvidence {
  std::vector<DwellData> dwells;  ///< those a fit may use
  DwellSpectrum spectrum;
  std::vector<SpectralLine> lines;
  DwellColour colour;
  TelegraphFit telegraph;  ///< fitted only where the colour asks for it
  CodeFindings codes;
};

[[nodiscard]] FastEvidence gather_fast_evidence(const Session& session,
                                                std::span<const Segment> segments,
                                                const Track& track);

/// Findings of spectrum, distribution and link, each over its gate.
[[nodiscard]] std::vector<Finding> fast_findings(const FastEvidence& evidence,
                                                 double sample_rate_hz);

/// Smallest amplitude each fast effect would have been found at, in the catalogue's unit.
[[nodiscard]] std::map<std::string, double> fast_limits(const FastEvidence& evidence);

}  // namespace gyrocal
