#include "compensation/discrepancy/slow_story.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "compensation/discrepancy/slow_options.h"

namespace gyrocal {
namespace {

constexpr std::size_t findings_max = 4;
constexpr int sweeps_max = 2;
// A curve that knows no physics must beat the named effects by this much before it is believed
// more than they: laws are never exact, and the curve picks up what they leave.
constexpr double curve_over_name = 1.5;
constexpr double unexplained_share = 0.12;
constexpr double unknown_gate_nats = 12;

/// What has been added so far; the model is made from it.
struct Chapter {
  SlowOption option;
};

void apply(SlowModel& model, const std::vector<Chapter>& chapters,
           const std::vector<SlowTerm>& given_terms, const NoiseFamily& given_noise,
           std::size_t leave_out) {
  std::vector<SlowTerm> terms = given_terms;
  NoiseFamily noise = given_noise;
  std::vector<std::vector<double>> shapes;
  Eigen::VectorXd known = Eigen::VectorXd::Zero(model.stream().size());
  for (std::size_t i = 0; i < chapters.size(); ++i) {
    if (i == leave_out) continue;
    const SlowOption& option = chapters[i].option;
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

std::vector<std::string> already(const std::vector<Chapter>& chapters,
                                 const std::vector<std::string>& excluded, std::size_t leave_out) {
  std::vector<std::string> names = excluded;
  for (std::size_t i = 0; i < chapters.size(); ++i) {
    // A second jump is a second event, a second sine a harmonic; a second hysteresis is a wrong
    // law.
    const std::string& name = chapters[i].option.finding.effect;
    const bool again = name == "bias_jump" || name == "mains_hum" || name == "unknown";
    if (i != leave_out && !again) names.push_back(name);
  }
  return names;
}

class Story {
 public:
  Story(SlowModel& model, double sample_rate_hz, const std::vector<std::string>& excluded)
      : model_(model),
        sample_rate_hz_(sample_rate_hz),
        excluded_(excluded),
        given_terms_(model.terms()),
        given_noise_(model.noise()) {}

  void tell() {
    while (chapters_.size() < findings_max && add_next()) {
    }
    for (int sweep = 0; sweep < sweeps_max && chapters_.size() > 1; ++sweep) {
      if (!swap()) break;
    }
    drop_weak();
    add_unexplained_rest();
  }

  std::vector<SlowFinding> findings() const {
    std::vector<SlowFinding> found;
    for (const Chapter& chapter : chapters_) found.push_back(chapter.option.finding);
    return found;
  }

 private:
  void remake(std::size_t leave_out = nobody) {
    apply(model_, chapters_, given_terms_, given_noise_, leave_out);
    if (leave_out != nobody) return;
    // The joint fit has the last word on amplitudes.
    std::size_t next = given_terms_.size();
    for (Chapter& chapter : chapters_) {
      if (!chapter.option.finding.term) continue;
      const SlowTerm& term = model_.terms()[next++];
      if (term.law->info.linear) {
        chapter.option.finding.term = term;
        chapter.option.finding.amplitude = term.values[0];
        chapter.option.finding.amplitude_sd = term.amplitude_sd;
      }
    }
  }

  bool add_next() {
    auto options = slow_options(model_, sample_rate_hz_, already(chapters_, excluded_, nobody));
    const auto best = std::find_if(options.begin(), options.end(), passes);
    if (best == options.end()) return false;
    judge(*best, options);
    chapters_.push_back({*best});
    remake();
    return true;
  }

  /// Takes each finding out, looks for the best in its place, keeps what is better.
  bool swap() {
    bool changed = false;
    for (std::size_t i = 0; i < chapters_.size(); ++i) {
      remake(i);
      auto options = slow_options(model_, sample_rate_hz_, already(chapters_, excluded_, i));
      const auto best = std::find_if(options.begin(), options.end(), passes);
      if (best == options.end()) continue;
      judge(*best, options);
      changed = changed || best->finding.effect != chapters_[i].option.finding.effect;
      chapters_[i].option = *best;
    }
    remake();
    return changed;
  }

  void drop_weak() {
    const auto weak = [](const Chapter& chapter) { return chapter.option.score < gate_nats; };
    if (std::none_of(chapters_.begin(), chapters_.end(), weak)) return;
    std::erase_if(chapters_, weak);
    remake();
  }

  void add_unexplained_rest() {
    double explained = 0;
    for (const Chapter& chapter : chapters_) explained += chapter.option.score;
    for (int i = 0; i < 2; ++i) {
      const auto gains = smooth_gains(model_);
      if (gains.front().nats < std::max(unknown_gate_nats, unexplained_share * explained)) return;
      withdraw_names_beaten_by(gains.front());
      chapters_.push_back({curve_option(gains.front())});
      remake();
    }
  }

  /// A name whose own driver still shows a curve of this weight was a wrong name.
  void withdraw_names_beaten_by(const SmoothGain& gain) {
    for (Chapter& chapter : chapters_) {
      if (chapter.option.finding.term && gain.nats * curve_over_name > chapter.option.score) {
        chapter.option.finding.rivals.push_back("unknown");
      }
    }
  }

  SlowModel& model_;
  double sample_rate_hz_;
  std::vector<std::string> excluded_;
  std::vector<SlowTerm> given_terms_;
  NoiseFamily given_noise_;
  std::vector<Chapter> chapters_;
};

}  // namespace

std::vector<SlowFinding> tell_slow_story(SlowModel& model, double sample_rate_hz,
                                         const std::vector<std::string>& excluded) {
  Story story(model, sample_rate_hz, excluded);
  story.tell();
  return story.findings();
}

}  // namespace gyrocal
