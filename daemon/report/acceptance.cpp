#include "daemon/report/acceptance.h"

#include <fmt/core.h>

#include <algorithm>

namespace gyrocal::report {

const char* to_text(Acceptance::Word word) {
  switch (word) {
    case Acceptance::Word::pass:
      return "PASS";
    case Acceptance::Word::marginal:
      return "MARGINAL";
    case Acceptance::Word::reject:
      return "REJECT";
    case Acceptance::Word::not_judged:
      break;
  }
  return "not judged";
}

Acceptance judge(const AxisFacts& axis, const AcceptanceConfig& limits) {
  using Word = Acceptance::Word;
  const auto best = std::find_if(axis.models.begin(), axis.models.end(),
                                 [](const ModelFacts& model) { return model.row.recommended; });
  if (!limits.pass_dps) return {Word::not_judged, "the campaign file sets no limit"};
  if (best == axis.models.end()) return {Word::reject, "there is no model"};
  const double error = best->row.loocv_rmse_dps;
  const double pass = *limits.pass_dps;
  const double reject = limits.reject_dps.value_or(pass);
  const Word word = error <= pass ? Word::pass : error <= reject ? Word::marginal : Word::reject;
  return {word, fmt::format("{} predicts setpoints it has not seen to {:.4f} deg/s; pass is {} at "
                            "most, reject above {}",
                            best->row.method, error, pass, reject)};
}

}  // namespace gyrocal::report
