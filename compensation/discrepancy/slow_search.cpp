#include "compensation/discrepancy/slow_search.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "compensation/discrepancy/off_design.h"
#include "compensation/discrepancy/scan_columns.h"
#include "compensation/discrepancy/simplex.h"
#include "compensation/values/assert.h"

namespace gyrocal {
namespace {

using Values = std::vector<double>;

constexpr double peak_worth_refining_nats = 3;
constexpr std::size_t starts_per_effect = 4;

/// A trial of one law and what it gained at one fixed noise.
struct Trial {
  const rig::Effect* effect;
  const rig::Law* law;
  Values values;
  double nats;
  std::size_t noise;  // index into the settings scanned
};

/// The best few rows of a law at one noise, no two of them neighbours in the scan.
void take_best(const ScanColumns& entry, const Eigen::VectorXd& gain, std::size_t noise,
               std::vector<Trial>& trials) {
  for (Eigen::Index i = 0; i < gain.size(); ++i) {
    const bool peak =
        (i == 0 || gain(i) >= gain(i - 1)) && (i + 1 == gain.size() || gain(i) > gain(i + 1));
    if (!peak || gain(i) < peak_worth_refining_nats) continue;
    trials.push_back(
        {entry.effect, entry.law, entry.rows[static_cast<std::size_t>(i)], gain(i), noise});
  }
}

/// The starts worth refining for each effect: the best at any noise, and at each noise the best.
std::vector<Trial> choose(std::vector<Trial> trials) {
  std::stable_sort(trials.begin(), trials.end(),
                   [](const Trial& a, const Trial& b) { return a.nats > b.nats; });
  std::vector<Trial> chosen;
  for (const rig::Effect& effect : rig::catalogue()) {
    std::size_t taken = 0;
    std::vector<std::pair<std::size_t, const rig::Law*>> seen;
    for (const Trial& trial : trials) {
      if (trial.effect != &effect || taken == starts_per_effect) continue;
      const std::pair key{trial.noise, trial.law};
      if (std::count(seen.begin(), seen.end(), key) > 0) continue;
      seen.push_back(key);
      chosen.push_back(trial);
      ++taken;
    }
  }
  return chosen;
}

/// The ranges a refinement may walk in, and the way to a space where a step of 1 is a grid step.
class ShapeSpace {
 public:
  ShapeSpace(const rig::Law& law, const std::vector<Values>& trials, const Values& at) : at_(at) {
    for (std::size_t i = law.info.linear ? 1 : 0; i < at.size(); ++i) {
      const rig::Parameter& parameter = law.info.parameters[i];
      const bool logarithmic = parameter.spacing == rig::Spacing::logarithmic;
      double low = trials.front()[i], high = low;
      for (const Values& row : trials) low = std::min(low, row[i]), high = std::max(high, row[i]);
      if (logarithmic) low /= 1.6, high *= 1.6;
      if (!logarithmic && i == 0) low = parameter.low, high = parameter.high;
      if (low == high) continue;  // not scanned: held
      low = std::max(low, parameter.low);
      high = std::min(high, parameter.high);
      const double step = i == 0                                     ? std::abs(at[0]) * 0.3
                          : parameter.unit == "degC" && !logarithmic ? 0.5
                                                                     : (high - low) / 20;
      free_.push_back({i, logarithmic, low, high, logarithmic ? 0.3 : std::max(step, 1e-6)});
    }
  }
  [[nodiscard]] Eigen::Index size() const { return static_cast<Eigen::Index>(free_.size()); }
  [[nodiscard]] Values values(const Eigen::VectorXd& x) const {
    Values result = at_;
    for (std::size_t k = 0; k < free_.size(); ++k) {
      const Free& free = free_[k];
      const double moved = x(static_cast<Eigen::Index>(k)) * free.step;
      const double value = free.logarithmic ? at_[free.at] * std::exp(moved) : at_[free.at] + moved;
      result[free.at] = std::clamp(value, free.low, free.high);
    }
    return result;
  }

 private:
  struct Free {
    std::size_t at;
    bool logarithmic;
    double low, high, step;
  };
  Values at_;
  std::vector<Free> free_;
};

/// y and design with one law in: as a column where it is linear, taken off y where it is not.
struct Extended {
  Eigen::VectorXd y;
  Eigen::MatrixXd design;
};

Extended extend(const SlowModel& model, const rig::Law& law, const Values& values) {
  Extended extended{model.y(), model.design()};
  if (!law.info.linear) {
    extended.y -= model.column(law, values);
    return extended;
  }
  Values unit = values;
  unit[0] = 1;
  extended.design.conservativeResize(Eigen::NoChange, model.design().cols() + 1);
  extended.design.rightCols(1) = model.column(law, unit);
  return extended;
}

bool degenerate(const SlowModel& model, const Extended& extended) {
  if (extended.design.cols() == model.design().cols()) return false;
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(model.design());
  const Eigen::VectorXd x = extended.design.rightCols(1);
  return (x - model.design() * qr.solve(x)).norm() <= 1e-4 * x.norm();
}

Values refine_shape(const SlowModel& model, const rig::Effect& effect, const rig::Law& law,
                    const Values& values, const SlowNoiseShape& noise) {
  const ShapeSpace space(law, trial_values(effect, law, model.track()), values);
  if (space.size() == 0) return values;
  const SlowWhitener whitener(model.stream().grid(), noise);
  const auto cost = [&](const Eigen::VectorXd& x) {
    const Extended extended = extend(model, law, space.values(x));
    return -fit_whitened(whitener, noise, extended.y, extended.design).log_likelihood;
  };
  const SimplexResult best =
      minimise(cost, Eigen::VectorXd::Zero(space.size()), Eigen::VectorXd::Ones(space.size()), 0.01,
               40 * static_cast<int>(space.size()));
  return space.values(best.at);
}

/// Standard error of the amplitude of a law that bends the bias: from the change of its column.
double bent_amplitude_sd(const SlowModel& model, const rig::Law& law, const Values& values,
                         const SlowNoiseShape& noise) {
  Values more = values;
  const double step = std::max(0.05 * std::abs(values[0]), 1e-3);
  more[0] += step;
  Extended extended{model.y() - model.column(law, values), model.design()};
  extended.design.conservativeResize(Eigen::NoChange, model.design().cols() + 1);
  extended.design.rightCols(1) = (model.column(law, more) - model.column(law, values)) / step;
  return fit_given_shape(model.stream().grid(), extended.y, extended.design, noise)
      .standard_error.tail(1)(0);
}

/// A window in temperature is one only if both its flanks were passed: a bend at the end of the
/// range is what any smooth curve has.
bool passed_whole(const SlowCandidate& candidate, const Track& track) {
  if (candidate.term.effect->name != "mode_crossing") return true;
  const double t0 = candidate.term.values[1], w = candidate.term.values[2];
  bool below = false, above = false;
  for (const rig::Drivers& now : track.record) {
    below = below || now.die_c < t0 - w;
    above = above || now.die_c > t0 + w;
  }
  return below && above;
}

/// A jump that nobody saw, in a gap of the stream, may be anywhere in it: the middle is least
/// wrong.
void centre_unseen_jump(SlowCandidate& candidate, const SlowGrid& grid) {
  constexpr double gap_s = 60;
  if (candidate.term.effect->name != "bias_jump") return;
  double& t0_s = candidate.term.values[1];
  const auto after = std::upper_bound(grid.t_s.begin(), grid.t_s.end(), t0_s);
  if (after == grid.t_s.begin() || after == grid.t_s.end()) return;
  const double before_s = *(after - 1);
  if (*after - before_s > gap_s) t0_s = (before_s + *after) / 2;
}

/// What a law is worth beside the others of its effect: each shape parameter is paid for, and the
/// usual law is preferred where there is nothing to choose.
double worth(const SlowCandidate& candidate) {
  const bool usual = candidate.term.law == candidate.term.effect->laws.front().get();
  return std::max(candidate.nats, 0.0) + (usual ? 1.0 : 0.0) -
         static_cast<double>(candidate.term.values.size() - 1);
}

}  // namespace

std::array<SlowNoiseShape, 3> noise_settings(const SlowModel& model) {
  const SlowNoiseShape free = model.fit_free().shape;
  return {free, {free.flicker_ratio * 0.05, free.walk_ratio * 0.05}, model.fit().shape};
}

SlowCandidate refine(const SlowModel& model, const rig::Effect& effect, const rig::Law& law,
                     std::vector<double> values, const SlowNoiseShape& start) {
  const SlowGrid& grid = model.stream().grid();
  SlowCandidate candidate;
  SlowNoiseShape noise = start;
  for (int pass = 0; pass < 2; ++pass) {
    values = refine_shape(model, effect, law, values, noise);
    const Extended extended = extend(model, law, values);
    if (degenerate(model, extended)) return candidate;
    candidate.fit = refit_noise(grid, extended.y, extended.design, all_noise, noise);
    noise = candidate.fit.shape;
  }
  const Extended extended = extend(model, law, values);
  const SlowFit same =
      refit_noise(grid, extended.y, extended.design, model.noise(), model.fit().shape);
  if (same.log_likelihood > candidate.fit.log_likelihood) candidate.fit = same;
  candidate.nats = candidate.fit.log_likelihood - model.fit_free().log_likelihood;
  candidate.nats_same_noise = same.log_likelihood - model.fit().log_likelihood;
  if (law.info.linear) {
    values[0] = candidate.fit.coefficients.tail(1)(0);
    candidate.term.amplitude_sd = candidate.fit.standard_error.tail(1)(0);
  } else {
    candidate.term.amplitude_sd = bent_amplitude_sd(model, law, values, candidate.fit.shape);
  }
  candidate.term.effect = &effect;
  candidate.term.law = &law;
  candidate.term.values = std::move(values);
  return candidate;
}

std::vector<SlowCandidate> search_effects(const SlowModel& model, const Executor& run_all) {
  const std::vector<ScanColumns> all = scan_columns(model);
  const auto settings = noise_settings(model);
  std::vector<Trial> trials;
  for (std::size_t s = 0; s < settings.size(); ++s) {
    if (s > 0 && settings[s] == settings[s - 1]) continue;
    const OffDesign design(model, settings[s]);
    const Eigen::VectorXd y_off = design.off(model.y());
    for (const ScanColumns& entry : all) {
      const Eigen::MatrixXd white = design.whitener().whiten(entry.columns);
      take_best(entry, column_gains(white, design.off_white(white), y_off), s, trials);
    }
  }
  const std::vector<Trial> starts = choose(std::move(trials));
  std::vector<SlowCandidate> refined(starts.size());
  run_all(starts.size(), [&](std::size_t i) {
    const Trial& start = starts[i];
    refined[i] = refine(model, *start.effect, *start.law, start.values, settings[start.noise]);
  });
  std::vector<SlowCandidate> best;
  for (SlowCandidate& candidate : refined) {
    if (candidate.term.effect == nullptr || !passed_whole(candidate, model.track())) continue;
    centre_unseen_jump(candidate, model.stream().grid());
    const auto same = std::find_if(best.begin(), best.end(), [&](const SlowCandidate& other) {
      return other.term.effect == candidate.term.effect;
    });
    if (same == best.end()) {
      best.push_back(std::move(candidate));
    } else if (worth(candidate) > worth(*same)) {
      *same = std::move(candidate);
    }
  }
  std::stable_sort(best.begin(), best.end(),
                   [](const SlowCandidate& a, const SlowCandidate& b) { return a.nats > b.nats; });
  return best;
}

}  // namespace gyrocal
