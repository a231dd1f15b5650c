#include "compensation/discrepancy/unseen_film.h"

#include <algorithm>
#include <cmath>

namespace gyrocal {
namespace {

constexpr double unseen_factor = 1.1;
constexpr double as_good_nats = 2;
constexpr double later_c_step = 0.5, later_c_max = 3;

double thickest_dps(const SlowModel& model, const SlowTerm& film) {
  double most = 0;
  const auto course = rig::drift_over(*film.law, film.values, model.bias(), model.track().record);
  for (const double drift_dps : course) most = std::max(most, std::abs(drift_dps));
  return most;
}

bool forms_unseen(const SlowModel& model, const SlowTerm& film) {
  const double seen_dps = model.column(*film.law, film.values).lpNorm<Eigen::Infinity>();
  return thickest_dps(model, film) > unseen_factor * seen_dps;
}

}  // namespace

SlowCandidate thinnest_film(const SlowModel& model, SlowCandidate candidate) {
  if (candidate.term.effect->name != "condensation_step") return candidate;
  if (!forms_unseen(model, candidate.term)) return candidate;
  SlowCandidate thinnest = candidate;
  for (double later_c = later_c_step; later_c <= later_c_max; later_c += later_c_step) {
    auto values = candidate.term.values;
    values[1] += later_c;
    SlowCandidate other = refine(model, *candidate.term.effect, *candidate.term.law,
                                 std::move(values), candidate.fit.shape);
    if (other.term.effect == nullptr || other.nats < candidate.nats - as_good_nats) continue;
    if (thickest_dps(model, other.term) < thickest_dps(model, thinnest.term)) {
      thinnest = std::move(other);
    }
  }
  return thinnest;
}

}  // namespace gyrocal
