#pragma once

#include <string>

#include "daemon/report/campaign_facts.h"

namespace gyrocal::report {

/// The word for one axis and the sentence that gives the reason.
struct Acceptance {
  enum class Word { pass, marginal, reject, not_judged } word = Word::not_judged;
  std::string reason;
};
[[nodiscard]] const char* to_text(Acceptance::Word word);

/// The recommended model's leave-one-out error against the campaign file's [acceptance]; REJECT
/// also where there is a limit and no model.
[[nodiscard]] Acceptance judge(const AxisFacts& axis, const AcceptanceConfig& limits);

}  // namespace gyrocal::report
