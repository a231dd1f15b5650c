#pragma once
#include <string>
#include <vector>

#include "tests/hidden_effects/judging.h"

namespace hidden {

/// Session by session, then truth against answer, then the targets; ends "N passed, N failed".
std::string report_text(const std::vector<Judged>& all);

/// JUnit, two suites: a test case a target, with the sessions that spoilt it; a test case a
/// session, failed where it was given a wrong or false name, or what was hidden was missed.
std::string report_junit(const std::vector<Judged>& all);

}  // namespace hidden
