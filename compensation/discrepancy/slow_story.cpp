#include "compensation/discrepancy/slow_story.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "compensation/discrepancy/slow_options.h"

namespace gyrocal {
namespace {

constexpr std::size_t findings_max = 4;
constexpr int sweeps_max = 2;
constexpr std::size_t crowd = 3;
constexpr double surely_no_noise_nats = 14;
constexpr double timing_s_min = 5;
// What a law leaves over because nature does not follow it to the letter is no second effect.
constexpr double imperfect_law_share = 0.03;
// A curve that knows no physics must beat the named effects by this much before it is believed
// more than they: laws are never exact, and the curve picks up what they leave.
constexpr double curve_over_name = 1.5;
constexpr double unexplained_share = 0.12;
constexpr double unknown_gate_nats = 12;

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

/// Over the gate, and not by what noise could do as well.
bool passes(const SlowOption& option) {
  return option.score >= gate_nats && option.beyond_noise >= gate_nats;
}

bool is_noise(const SlowOption& option) { return option.noise.flicker || option.noise.walk; }

constexpr std::size_t nobody = static_cast<std::size_t>(-1);

/// Evidence, lead and rivals of the best option among all.
void judge(SlowOption& chosen, const std::vector<SlowOption>& all) {
  chosen.finding.evidence_nats = chosen.score;
  chosen.finding.lead_nats = chosen.score;
  chosen.finding.rivals.clear();
  for (const SlowOption& other : all) {
    if (other.finding.effect == chosen.finding.effect) continue;
    const double lead = chosen.score - std::max(other.score, 0.0);
    chosen.finding.lead_nats = std::min(chosen.finding.lead_nats, lead);
    if (lead < lead_to_name_nats && other.score >= gate_nats - lead_to_name_nats) {
      chosen.finding.rivals.push_back(other.finding.effect);
    }
  }
}

SlowOption curve_option(const SmoothGain& gain) {
  SlowOption option;
  option.score = gain.nats;
  option.finding.effect = "unknown";
  option.finding.law = "curve";
  option.finding.amplitude = gain.rms_dps;
  option.finding.evidence_nats = gain.nats;
  option.finding.lead_nats = gain.nats;
  option.finding.unknown_driver = gain.driver;
  option.finding.courses = {gain.curve};
  option.finding.parameters = {{"peak_dps", gain.peak_dps}, {"peak_at", gain.peak_at}};
  option.finding.description = fmt::format(
      "a drift that follows {} ({:.3g} mdps rms, largest {:+.3g} mdps at {:.4g} {}); no effect of "
      "the catalogue has this shape",
      gain.driver, gain.rms_dps * 1000, gain.peak_dps * 1000, gain.peak_at, gain.unit);
  return option;
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

/// See SlowFinding::effective_amplitude.
double effective_amplitude(const SlowFinding& finding, const SlowModel& model) {
  if (!finding.term) return 0;
  if (finding.effect == "g_sensitivity" && finding.law == "measured") {
    const auto& values = finding.term->values;
    return values[0] * std::sqrt(1 + values[1] * values[1] + values[2] * values[2]);
  }
  const bool aging = finding.effect == "aging_drift" && finding.law != "linear";
  if (!aging && finding.effect != "condensation_step") return 0;
  const auto& record = model.track().record;
  const auto course =
      rig::drift_over(*finding.term->law, finding.term->values, model.bias(), record);
  if (aging) {
    const double hours = (record.back().t_s - record.front().t_s) / 3600;
    return (course.back() - course.front()) / hours * 1000;
  }
  return *std::max_element(course.begin(), course.end(),
                           [](double a, double b) { return std::abs(a) < std::abs(b); });
}

class Story {
 public:
  Story(SlowModel& model, double sample_rate_hz, double interval_s,
        const std::vector<std::string>& excluded)
      : model_(model),
        sample_rate_hz_(sample_rate_hz),
        excluded_(excluded),
        given_{model.terms(), model.noise(), timing_error(model, interval_s)} {
    if (!given_.shapes.empty()) remake();
  }

  void tell() {
    while (chapters_.size() < findings_max && add_next()) {
    }
    for (int sweep = 0; sweep < sweeps_max && worth_another_look(); ++sweep) {
      if (!swap()) break;
    }
    withdraw_a_crowd();
    add_unexplained_rest();
  }

  std::vector<SlowFinding> findings() const {
    std::vector<SlowFinding> found;
    for (const SlowOption& chapter : chapters_) {
      found.push_back(chapter.finding);
      found.back().effective_amplitude = effective_amplitude(found.back(), model_);
    }
    return found;
  }

 private:
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
    auto options = slow_options(model_, sample_rate_hz_, already(chapters_, excluded_, nobody));
    const auto best = choose_next(options);
    if (best == options.end()) return false;
    judge(*best, options);
    if (curve_is_better_than(*best)) return false;
    chapters_.push_back(*best);
    remake();
    return true;
  }

  [[nodiscard]] bool worth_another_look() const {
    return chapters_.size() > 1 ||
           (chapters_.size() == 1 && !chapters_.front().finding.rivals.empty());
  }

  /// Takes each finding out and looks for the best in its place: keeps what is better, and leaves
  /// the place empty where nothing is missed.
  bool swap() {
    bool changed = false;
    for (std::size_t i = 0; i < chapters_.size();) {
      remake(i);
      auto options = slow_options(model_, sample_rate_hz_, already(chapters_, excluded_, i));
      const auto best = std::find_if(options.begin(), options.end(), passes);
      if (best == options.end()) {
        chapters_.erase(chapters_.begin() + static_cast<std::ptrdiff_t>(i));
        changed = true;
        continue;
      }
      judge(*best, options);
      changed = changed || best->finding.effect != chapters_[i].finding.effect;
      chapters_[i] = *best;
      ++i;
    }
    remake();
    return changed;
  }

  /// Drift that no noise could make goes first: noise takes the trace of several effects at once
  /// and would leave too little of each to see. Among such drifts, the one that leaves noise least.
  [[nodiscard]] std::vector<SlowOption>::iterator choose_next(
      std::vector<SlowOption>& options) const {
    const auto enough = [this](const SlowOption& option) {
      return passes(option) && option.score >= imperfect_law_share * explained();
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

  /// What the strongest deterministic finding explains.
  [[nodiscard]] double explained() const {
    double most = 0;
    for (const SlowOption& chapter : chapters_) {
      if (!is_noise(chapter)) most = std::max(most, chapter.score);
    }
    return most;
  }

  /// Whether a curve that knows no physics does so much better that the name is not believed.
  [[nodiscard]] bool curve_is_better_than(const SlowOption& option) const {
    return smooth_gains(model_).front().nats > curve_over_name * option.beyond_noise + gate_nats;
  }

  /// Nature has one fault, seldom two. Where three or more laws are needed, they are the words of
  /// the wrong language: what they describe is kept, their names are not.
  void withdraw_a_crowd() {
    if (chapters_.size() < crowd) return;
    // One course for all parts: side by side they would be nearly dependent.
    std::vector<double> together(model_.track().record.size(), 0.0);
    for (SlowOption& chapter : chapters_) {
      SlowFinding& finding = chapter.finding;
      if (finding.effect == "unknown") continue;
      finding.description = fmt::format(
          "a part that {} would describe ({:.3g} in its unit), but {} such parts are needed, so "
          "the "
          "names are not believed",
          finding.effect, finding.amplitude, chapters_.size());
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
    SlowFinding& first = chapters_.front().finding;
    if (std::any_of(together.begin(), together.end(), [](double dps) { return dps != 0; })) {
      first.courses.push_back(std::move(together));
      first.unknown_driver = "time";
    }
    remake();
  }

  void add_unexplained_rest() {
    double named = 0;
    for (const SlowOption& chapter : chapters_) named += chapter.score;
    for (int i = 0; i < 2; ++i) {
      const auto gains = smooth_gains(model_);
      if (gains.front().nats < std::max(unknown_gate_nats, unexplained_share * named)) return;
      withdraw_names_beaten_by(gains.front());
      chapters_.push_back(curve_option(gains.front()));
      remake();
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
  double sample_rate_hz_;
  std::vector<std::string> excluded_;
  Given given_;
  std::vector<SlowOption> chapters_;
};

}  // namespace

std::vector<SlowFinding> tell_slow_story(SlowModel& model, double sample_rate_hz, double interval_s,
                                         const std::vector<std::string>& excluded) {
  Story story(model, sample_rate_hz, interval_s, excluded);
  story.tell();
  return story.findings();
}

}  // namespace gyrocal
