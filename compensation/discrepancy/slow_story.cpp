#include "compensation/discrepancy/slow_story.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "compensation/discrepancy/slow_doubts.h"
#include "compensation/discrepancy/slow_options.h"
#include "compensation/discrepancy/told_amplitude.h"

namespace gyrocal {
namespace {

constexpr std::size_t findings_max = 4;
constexpr int sweeps_max = 2;
constexpr std::size_t crowd = 3;
constexpr double surely_no_noise_nats = 14;
constexpr double timing_s_min = 5;
// What a law leaves over because nature does not follow it to the letter is no second effect.
constexpr double imperfect_law_share = 0.1;
// When a compressor runs is only guessed from the air.
constexpr double guessed_law_share = 0.18;
constexpr double unexplained_share = 0.12;

/// What the model had before the story began.
struct Given {
  std::vector<SlowTerm> terms;
  NoiseFamily noise;
  std::vector<std::vector<double>> shapes;
};

/// The drift that a wrong instant of the temperatures makes: readings are polled, averaged and
/// stamped, and may be off by an interval. Returned where it is that small and of any use; a longer
/// lag is physics and must be found by its name.
std::vector<std::vector<double>> timing_error(const SlowModel& model, double interval_s) {
  std::vector<double> course;
  for (const rig::Drivers& now : model.track().record) {
    course.push_back(model.bias().slope(now.die_c) * now.die_rate_c_per_min / 60);
  }
  const Eigen::VectorXd column = model.stream().bin(course);
  if (column.norm() == 0) return {};
  Eigen::MatrixXd design(model.y().size(), model.design().cols() + 1);
  design << model.design(), column;
  const SlowFit fit = refit_noise(model.stream().grid(), model.y(), design,
                                  {.flicker = true, .walk = true}, model.fit_free().shape);
  const bool small = std::abs(fit.coefficients.tail(1)(0)) <= std::max(interval_s, timing_s_min);
  const bool useful = fit.log_likelihood > model.fit_free().log_likelihood + 2;
  if (!small || !useful) return {};
  return {std::move(course)};
}

void apply(SlowModel& model, const std::vector<SlowOption>& chapters, const Given& given,
           std::size_t leave_out) {
  std::vector<SlowTerm> terms = given.terms;
  NoiseFamily noise = given.noise;
  std::vector<std::vector<double>> shapes = given.shapes;
  Eigen::VectorXd known = Eigen::VectorXd::Zero(model.stream().size());
  for (std::size_t i = 0; i < chapters.size(); ++i) {
    if (i == leave_out) continue;
    const SlowOption& option = chapters[i];
    if (option.finding.term) terms.push_back(*option.finding.term);
    noise.flicker = noise.flicker || option.noise.flicker;
    noise.walk = noise.walk || option.noise.walk;
    for (const auto& course : option.finding.courses) shapes.push_back(course);
    if (option.known_bins.size() > 0) known += option.known_bins;
  }
  model.set_terms(std::move(terms));
  model.set_noise(noise);
  model.set_shapes(std::move(shapes));
  model.set_known_bins(known);
  model.refit();
}

/// The share of what a law explains that it may leave over.
double left_of(const SlowOption& chapter, double usual_share) {
  return chapter.finding.effect == "compressor_vibration" ? guessed_law_share : usual_share;
}

constexpr std::size_t nobody = static_cast<std::size_t>(-1);

/// A relay that flips once and a bend passed once are a jump by another name: what happens once is
/// an event.
bool happens_once(const SlowOption& chosen, const SlowOption& other) {
  const std::string& law = other.finding.law;
  return chosen.finding.effect == "bias_jump" && (law == "relay" || law == "turn");
}

std::vector<SlowRank> ranking_of(const std::vector<SlowOption>& all) {
  std::vector<SlowRank> ranking;
  for (const SlowOption& option : all) {
    if (option.score <= 0) continue;
    ranking.push_back({option.finding.effect, option.finding.law, option.score});
  }
  return ranking;
}

double lead_over(const SlowModel& model, const SlowOption& chosen, const SlowOption& other) {
  if (chosen.finding.term && other.finding.term) {
    return with_own_noise(model, chosen) - with_own_noise(model, other);
  }
  const double lead = chosen.score - std::max(other.score, 0.0);
  // A law may stand beside noise: what it gains then is its lead over noise alone.
  return is_noise(other) && chosen.finding.term ? std::max(lead, chosen.beyond_noise) : lead;
}

/// Evidence, lead and rivals of the best option among all, and of what the search cannot see
/// (slow_doubts.h).
void judge(const SlowModel& model, SlowOption& chosen, const std::vector<SlowOption>& all) {
  chosen.finding.evidence_nats = chosen.score;
  chosen.finding.lead_nats = chosen.score;
  chosen.finding.rivals.clear();
  chosen.finding.ranking = ranking_of(all);
  if (is_unknown(chosen)) return;
  for (const SlowOption& other : all) {
    if (other.finding.effect == chosen.finding.effect || is_unknown(other)) continue;
    const double lead = lead_over(model, chosen, other);
    if (lead >= 0 && happens_once(chosen, other)) continue;
    chosen.finding.lead_nats = std::min(chosen.finding.lead_nats, lead);
    if (lead < lead_to_name_nats && other.score >= gate_nats - lead_to_name_nats) {
      chosen.finding.rivals.push_back(other.finding.effect);
    }
  }
  doubt_lags(model, chosen);
}

std::vector<std::string> already(const std::vector<SlowOption>& chapters,
                                 const std::vector<std::string>& excluded, std::size_t leave_out) {
  std::vector<std::string> names = excluded;
  for (std::size_t i = 0; i < chapters.size(); ++i) {
    // A second jump is a second event, a second sine a harmonic; a second hysteresis is a wrong
    // law.
    const std::string& name = chapters[i].finding.effect;
    const bool again = name == "bias_jump" || name == "mains_hum" || name == "unknown";
    if (i != leave_out && !again) names.push_back(name);
  }
  return names;
}

class Story {
 public:
  Story(SlowModel& model, double sample_rate_hz, double interval_s,
        const std::vector<std::string>& excluded, double gate, double known_nats,
        const Executor& run_all)
      : model_(model),
        gate_nats_(gate),
        known_leftover_(known_leftover_share * known_nats),
        run_all_(run_all),
        sample_rate_hz_(sample_rate_hz),
        excluded_(excluded),
        given_{model.terms(), model.noise(), timing_error(model, interval_s)} {
    if (!given_.shapes.empty()) remake();
  }

  void tell() {
    while (chapters_.size() < findings_max && add_next()) {
    }
    for (int sweep = 0; sweep < sweeps_max && worth_another_look(); ++sweep) {
      const std::vector<SlowOption> before = chapters_;
      const double explained = model_.fit().log_likelihood;
      if (!swap()) break;
      if (noise_replaced_more(before, explained)) {
        chapters_ = before;
        remake();
        break;
      }
    }
    withdraw_a_crowd();
    add_unexplained_rest();
    withdraw_shadows();
  }

  std::vector<SlowFinding> findings() const {
    std::vector<SlowFinding> found;
    for (const SlowOption& chapter : chapters_) {
      found.push_back(chapter.finding);
      found.back().effective_amplitude = told_amplitude(found.back(), model_);
    }
    return found;
  }

 private:
  /// Over the gate, and not by what noise could do as well.
  [[nodiscard]] bool passes(const SlowOption& option) const {
    return option.score >= gate_nats_ && option.beyond_noise >= gate_nats_;
  }

  void remake(std::size_t leave_out = nobody) {
    apply(model_, chapters_, given_, leave_out);
    if (leave_out != nobody) return;
    // The joint fit has the last word on amplitudes.
    std::size_t next = given_.terms.size();
    for (SlowOption& chapter : chapters_) {
      if (!chapter.finding.term) continue;
      const SlowTerm& term = model_.terms()[next++];
      if (term.law->info.linear) {
        chapter.finding.term = term;
        chapter.finding.amplitude = term.values[0];
        chapter.finding.amplitude_sd = term.amplitude_sd;
      }
    }
  }

  bool add_next() {
    auto options =
        slow_options(model_, sample_rate_hz_, already(chapters_, excluded_, nobody), run_all_);
    const auto best = choose_next(options);
    if (best == options.end()) return false;
    judge(model_, *best, options);
    const SmoothGain curve = smooth_gains(model_).front();
    if (curve_beats_name(curve, *best) || curve_outlives_name(curve, *best)) return false;
    SlowOption next = curve_beats_chance(curve, *best) ? curve_option(curve) : *best;
    next.finding.ranking = best->finding.ranking;
    add(std::move(next));
    return true;
  }

  /// Whether a curve that leads a law gains nearly as much once that law is in: then the law is
  /// about something else, or about nothing.
  [[nodiscard]] bool curve_outlives_name(const SmoothGain& curve, const SlowOption& option) {
    constexpr double outlives = 0.6;
    if (!option.finding.term || curve.nats < unknown_gate_nats) return false;
    if (curve.nats < option.beyond_noise + lead_to_name_nats) return false;
    chapters_.push_back(option);
    remake();
    const auto left = smooth_gains(model_);
    chapters_.pop_back();
    remake();
    const auto same = std::find_if(left.begin(), left.end(), [&](const SmoothGain& gain) {
      return gain.driver == curve.driver;
    });
    return same->nats > outlives * curve.nats;
  }

  /// What a curve or a noise without a name explains is what the fit gains by it, whatever else
  /// could have.
  void add(SlowOption option) {
    const double before = model_.fit().log_likelihood;
    chapters_.push_back(std::move(option));
    remake();
    SlowOption& added = chapters_.back();
    if (!is_unknown(added)) return;
    added.score = std::max(added.score, model_.fit().log_likelihood - before);
    added.finding.evidence_nats = added.score;
  }

  /// Where what has no name leads, no name will be believed whatever its place.
  [[nodiscard]] bool worth_another_look() const {
    const auto strongest = std::max_element(
        chapters_.begin(), chapters_.end(),
        [](const SlowOption& a, const SlowOption& b) { return a.score < b.score; });
    if (strongest == chapters_.end() || is_unknown(*strongest)) return false;
    return chapters_.size() > 1 ||
           (chapters_.size() == 1 && !chapters_.front().finding.rivals.empty());
  }

  /// Takes each finding out and looks for the best in its place: keeps what is better, and leaves
  /// the place empty where nothing is missed.
  bool swap() {
    bool changed = false;
    for (std::size_t i = 0; i < chapters_.size();) {
      remake(i);
      auto options =
          slow_options(model_, sample_rate_hz_, already(chapters_, excluded_, i), run_all_);
      const double leftover = expected_leftover(i);
      const auto best = std::find_if(options.begin(), options.end(), [&](const SlowOption& option) {
        return passes(option) && option.score >= leftover;
      });
      if (is_curve(chapters_[i]) && curve_still_leads(best == options.end() ? nullptr : &*best)) {
        ++i;
        continue;
      }
      if (best == options.end()) {
        chapters_.erase(chapters_.begin() + static_cast<std::ptrdiff_t>(i));
        changed = true;
        continue;
      }
      judge(model_, *best, options);
      changed = changed || best->finding.effect != chapters_[i].finding.effect;
      chapters_[i] = *best;
      ++i;
    }
    remake();
    return changed;
  }

  /// Findings are taken out one at a time; two laws that need each other can so fall to a noise
  /// that explains less than both.
  [[nodiscard]] bool noise_replaced_more(const std::vector<SlowOption>& before,
                                         double explained) const {
    const bool noise_now = std::any_of(chapters_.begin(), chapters_.end(), is_noise);
    const bool noise_then = std::any_of(before.begin(), before.end(), is_noise);
    return noise_now && !noise_then && explained > model_.fit().log_likelihood + lead_to_name_nats;
  }

  /// Drift that no noise could make goes first: noise takes the trace of several effects at once
  /// and would leave too little of each to see. Among such drifts, the one that leaves noise least.
  [[nodiscard]] std::vector<SlowOption>::iterator choose_next(
      std::vector<SlowOption>& options) const {
    const auto enough = [this](const SlowOption& option) {
      return passes(option) && option.score >= expected_leftover(nobody);
    };
    auto best = options.end();
    for (auto option = options.begin(); option != options.end(); ++option) {
      if (!enough(*option) || is_noise(*option) || option->beyond_noise < surely_no_noise_nats) {
        continue;
      }
      if (best == options.end() || option->beyond_noise > best->beyond_noise) best = option;
    }
    return best != options.end() ? best : std::find_if(options.begin(), options.end(), enough);
  }

  /// What the deterministic findings, not being exact, may leave over.
  [[nodiscard]] double expected_leftover(std::size_t leave_out) const {
    double most = known_leftover_;
    for (std::size_t i = 0; i < chapters_.size(); ++i) {
      const SlowOption& chapter = chapters_[i];
      if (i == leave_out || is_noise(chapter)) continue;
      most = std::max(most, left_of(chapter, imperfect_law_share) * chapter.score);
    }
    return most;
  }

  /// Whether a curve, taken out, still says more beyond all noise than any effect in its place.
  [[nodiscard]] bool curve_still_leads(const SlowOption* best) const {
    const SmoothGain curve = smooth_gains(model_).front();
    return curve.nats >= unknown_gate_nats &&
           (best == nullptr || curve_beats_chance(curve, *best) || curve_beats_name(curve, *best));
  }

  /// Nature has one fault, seldom two. Where three or more laws are needed, they are the words of
  /// the wrong language: what they describe is kept, their names are not.
  void withdraw_a_crowd() {
    if (chapters_.size() < crowd) return;
    withdraw([](const SlowOption&) { return true; },
             fmt::format("{} such parts are needed", chapters_.size()));
  }

  /// Beside something larger that has no name, a name may be no more than a word for its remainder;
  /// and what a curve leaves of a drift that follows more than one driver wanders as noise does.
  void withdraw_shadows() {
    double unknown = 0;
    bool curved = false;
    for (const SlowOption& chapter : chapters_) {
      if (is_unknown(chapter)) unknown = std::max(unknown, chapter.score);
      curved = curved || is_curve(chapter);
    }
    withdraw([unknown](const SlowOption& chapter) { return chapter.score < unknown; },
             "something larger without a name is there too");
    if (!curved) return;
    withdraw([](const SlowOption& chapter) { return is_noise(chapter); },
             "a drift without a name is there too, and what its curve leaves over wanders");
  }

  /// Keeps what these chapters describe and takes their names away.
  template <class Doubted>
  void withdraw(const Doubted& doubted, const std::string& why) {
    // One course for all parts: side by side they would be nearly dependent.
    std::vector<double> together(model_.track().record.size(), 0.0);
    SlowFinding* first = nullptr;
    for (SlowOption& chapter : chapters_) {
      SlowFinding& finding = chapter.finding;
      if (is_unknown(chapter) || !doubted(chapter)) continue;
      if (first == nullptr) first = &finding;
      finding.description = fmt::format(
          "a part that {} would describe ({:.3g} in its unit), but {}, so its name is not believed",
          finding.effect, finding.amplitude, why);
      if (finding.term) {
        const auto part = rig::drift_over(*finding.term->law, finding.term->values, model_.bias(),
                                          model_.track().record);
        for (std::size_t k = 0; k < part.size(); ++k) together[k] += part[k];
        finding.term.reset();
      }
      finding.effect = "unknown";
      finding.law = "part";
      finding.rivals.clear();
      finding.parameters.clear();
    }
    if (first == nullptr) return;
    if (std::any_of(together.begin(), together.end(), [](double dps) { return dps != 0; })) {
      first->courses.push_back(std::move(together));
      first->unknown_driver = "time";
    }
    remake();
  }

  void add_unexplained_rest() {
    double expected = 0;
    for (const SlowOption& chapter : chapters_) {
      expected += left_of(chapter, unexplained_share) * chapter.score;
    }
    for (int i = 0; i < 2; ++i) {
      const auto gains = smooth_gains(model_);
      if (gains.front().nats < std::max({unknown_gate_nats, expected, known_leftover_})) return;
      withdraw_names_beaten_by(gains.front());
      add(curve_option(gains.front()));
    }
  }

  /// A name whose own driver still shows a curve of this weight was a wrong name.
  void withdraw_names_beaten_by(const SmoothGain& gain) {
    for (SlowOption& chapter : chapters_) {
      if (chapter.finding.term && gain.nats * curve_over_name > chapter.score) {
        chapter.finding.rivals.push_back("unknown");
      }
    }
  }

  SlowModel& model_;
  double gate_nats_;
  double known_leftover_;  ///< [nat]
  const Executor& run_all_;
  double sample_rate_hz_;
  std::vector<std::string> excluded_;
  Given given_;
  std::vector<SlowOption> chapters_;
};

}  // namespace

std::vector<SlowFinding> tell_slow_story(SlowModel& model, double sample_rate_hz, double interval_s,
                                         const std::vector<std::string>& excluded, double gate,
                                         double known_nats, const Executor& run_all) {
  Story story(model, sample_rate_hz, interval_s, excluded, gate, known_nats, run_all);
  story.tell();
  return story.findings();
}

}  // namespace gyrocal
