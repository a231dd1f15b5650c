#include "tests/hidden_effects/judging.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "tests/hidden_effects/units_of_amplitude.h"

namespace hidden {
namespace {

bool contains(const std::vector<std::string>& list, const std::string& name) {
  return std::find(list.begin(), list.end(), name) != list.end();
}

bool is_set(const Finding& finding) { return !finding.confounded_with.empty(); }

bool speaks_of(const Finding& finding, const std::string& name) {
  return finding.effect == name || contains(finding.confounded_with, name);
}

/// A confounded answer counts where the truth itself allows one.
bool names(const Finding& finding, const TrueEffect& effect, const Truth& truth) {
  if (!is_set(finding)) return finding.effect == effect.name;
  return speaks_of(finding, effect.name) && contains(truth.accepted_verdicts, "confounded");
}

std::string written(const Finding& finding) {
  std::string text = finding.effect;
  for (const auto& other : finding.confounded_with) text += "|" + other;
  return text;
}

bool is_wrong(const Finding& finding, const Truth& truth) {
  if (finding.effect == "unknown" && !is_set(finding)) return false;
  return std::none_of(truth.effects.begin(), truth.effects.end(), [&](const TrueEffect& effect) {
    return effect.name != "unknown" && speaks_of(finding, effect.name);
  });
}

/// Smallest relative error over the ways the truth may be stated. A unit that compares with none of
/// them is as far off as saying nothing.
double error_of(const Finding& finding, const TrueEffect& effect) {
  double least = 1.0;
  bool comparable = false;
  const auto said = coherent(finding.amplitude, finding.unit);
  for (const auto& amplitude : effect.amplitudes) {
    const auto is = coherent(amplitude.value, amplitude.unit);
    if (!said || !is || said->kind != is->kind || is->value == 0.0) continue;
    const double off = effect.signed_amplitude
                           ? std::abs(said->value - is->value)
                           : std::abs(std::abs(said->value) - std::abs(is->value));
    const double relative = off / std::abs(is->value);
    least = comparable ? std::min(least, relative) : relative;
    comparable = true;
  }
  return least;
}

/// Collects one rate and who spoilt it.
class Rate {
 public:
  void add(bool counts, const Judged& session) {
    ++cases_;
    if (counts) {
      ++hits_;
      hit_.push_back(session.truth.name);
    } else {
      missed_.push_back(session.truth.name);
    }
  }
  Target at_least(const std::string& name, double wanted) const {
    return {name, share(), wanted, true, cases_, missed_};
  }
  Target at_most(const std::string& name, double wanted) const {
    return {name, share(), wanted, false, cases_, hit_};
  }

 private:
  double share() const {
    return cases_ == 0 ? 0.0 : static_cast<double>(hits_) / static_cast<double>(cases_);
  }
  std::size_t cases_ = 0, hits_ = 0;
  std::vector<std::string> hit_, missed_;
};

Rate recall(const std::vector<Judged>& all, const std::string& level) {
  Rate rate;
  for (const auto& session : all) {
    const std::string& category = session.truth.category;
    if (session.truth.level != level || (category != "single" && category != "pair")) continue;
    for (const bool found : session.found) rate.add(found, session);
  }
  return rate;
}

Rate rate_over(const std::vector<Judged>& all, const std::function<bool(const Judged&)>& belongs,
               const std::function<bool(const Judged&)>& counts) {
  Rate rate;
  for (const auto& session : all) {
    if (belongs(session)) rate.add(counts(session), session);
  }
  return rate;
}

std::function<bool(const Judged&)> of_category(const std::string& category) {
  return [category](const Judged& session) { return session.truth.category == category; };
}

Target amplitude_target(const std::vector<Judged>& all) {
  std::vector<double> errors;
  std::vector<std::string> culprits;
  for (const auto& session : all) {
    for (const auto& error : session.amplitude_error) {
      if (!error) continue;
      errors.push_back(*error);
      if (*error > 0.1) culprits.push_back(session.truth.name);
    }
  }
  return {"median amplitude error", median(errors), 0.1, false, errors.size(), culprits};
}

Target gap_target(const std::vector<Judged>& all) {
  double sum = 0.0;
  std::size_t cases = 0;
  std::vector<std::string> culprits;
  for (const auto& session : all) {
    if (!session.gap_closed) continue;
    ++cases;
    sum += std::max(*session.gap_closed, -1.0);
    if (*session.gap_closed < 0.8) culprits.push_back(session.truth.name);
  }
  return {"mean share of the excess gap closed",
          cases == 0 ? 0.0 : sum / static_cast<double>(cases),
          0.8,
          true,
          cases,
          culprits};
}

std::vector<Target> naming_targets(const std::vector<Judged>& all) {
  const auto any = [](const Judged&) { return true; };
  const auto hides = [](const Judged& s) { return s.truth.category != "null"; };
  const auto wrong = [](const Judged& s) { return !s.wrong_names.empty(); };
  return {rate_over(all, any, [](const Judged& s) { return s.answer.trouble.empty(); })
              .at_least("every session answered", 1.0),
          recall(all, "strong").at_least("strong effects named", 0.95),
          recall(all, "moderate").at_least("moderate effects named", 0.85),
          rate_over(all, of_category("null"), wrong).at_most("false names on nulls", 0.02),
          rate_over(all, hides, wrong).at_most("wrong names", 0.02),
          rate_over(all, of_category("outside"),
                    [](const Judged& s) {
                      return s.admitted || (s.said_confounded &&
                                            contains(s.truth.accepted_verdicts, "confounded"));
                    })
              .at_least("outside the catalogue said unexplained", 0.90),
          rate_over(all, of_category("confounded"), [](const Judged& s) {
            return s.said_confounded ||
                   (contains(s.truth.accepted_verdicts, "explained") && s.found.front());
          }).at_least("confounded said", 0.90)};
}

/// Only where something was hidden, and only if there was a gap to close.
std::optional<double> share_closed(const Truth& truth, const Answer& answer) {
  if (truth.category == "null" || !answer.trouble.empty()) return std::nullopt;
  const double before = answer.gap_before * answer.gap_before;
  const double after = answer.gap_after * answer.gap_after;
  if (before > 0.0) return 1.0 - after / before;
  return after > 0.0 ? std::optional(-1.0) : std::nullopt;
}

}  // namespace

double median(std::vector<double> values) {
  if (values.empty()) return 0.0;
  std::sort(values.begin(), values.end());
  const std::size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : 0.5 * (values[half - 1] + values[half]);
}

Judged judge(const Truth& truth, const Answer& answer) {
  Judged session{truth, answer, {}, {}, {}, false, false, share_closed(truth, answer)};
  for (const auto& effect : truth.effects) {
    const auto said = std::find_if(answer.findings.begin(), answer.findings.end(),
                                   [&](const Finding& f) { return names(f, effect, truth); });
    const bool found = said != answer.findings.end();
    session.found.push_back(found);
    session.amplitude_error.push_back(
        found && effect.name != "unknown" ? std::optional(error_of(*said, effect)) : std::nullopt);
  }
  bool named = false;
  for (const auto& finding : answer.findings) {
    if (is_wrong(finding, truth)) session.wrong_names.push_back(written(finding));
    named = named || finding.effect != "unknown";
    for (const auto& effect : truth.effects) {
      session.said_confounded =
          session.said_confounded ||
          (answer.verdict == "confounded" && is_set(finding) && speaks_of(finding, effect.name));
    }
  }
  session.admitted = answer.verdict == "unexplained" && !named;
  return session;
}

std::vector<Target> targets(const std::vector<Judged>& all) {
  auto each = naming_targets(all);
  each.push_back(amplitude_target(all));
  each.push_back(gap_target(all));
  return each;
}

std::vector<std::string> failings(const Judged& session) {
  std::vector<std::string> missed;
  for (const Target& target : naming_targets({session})) {
    if (!target.culprits.empty()) missed.push_back(target.name);
  }
  return missed;
}

}  // namespace hidden
