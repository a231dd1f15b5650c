#pragma once
#include <string>
#include <vector>

#include "tests/hidden_effects/judging.h"

namespace hidden {

/// Session by session, then truth against answer, then the targets; ends "N passed, N failed".
std::string report_text(const std::vector<Judged>& all);

/// One JUnit test case a target, the sessions that spoilt it in its failure.
std::string report_junit(const std::vector<Judged>& all);

}  // namespace hidden
