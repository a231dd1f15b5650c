#include "compensation/rig/active_effects.h"

#include <algorithm>

#include "compensation/rig/empirical_term.h"

namespace gyrocal::rig {
namespace {

bool felt_by(const Instance& instance, std::uint32_t board) {
  const auto& boards = instance.boards;
  return boards.empty() || std::find(boards.begin(), boards.end(), board) != boards.end();
}

/// Whoever shares an instance shares its random stream.
StreamKey stream_key(const Instance& instance, std::uint64_t seed, std::uint32_t board,
                     std::uint32_t axis, std::size_t place, std::uint32_t use) {
  const Scope scope = instance.effect->scope;
  return {seed, scope == Scope::environment ? 0 : board, scope == Scope::axis ? axis : 0,
          first_effect + 2 * static_cast<std::uint32_t>(place) + use};
}

}  // namespace

AxisEffects::AxisEffects(const RigModel& model, std::span<const Instance> instances,
                         std::uint64_t seed, std::uint32_t board, std::uint32_t axis,
                         const CubicBias& bias) {
  for (std::size_t i = 0; i < instances.size(); ++i) {
    const Instance& instance = instances[i];
    if (!felt_by(instance, board) || !instance.axes[axis]) continue;
    const auto key = [&](std::uint32_t use) {
      return stream_key(instance, seed, board, axis, i, use);
    };
    if (auto drift = instance.law->drift(instance.values, bias)) {
      responses_.push_back(std::move(drift));
    }
    if (auto change = instance.law->samples(instance.values, key(0))) {
      changes_.push_back(std::move(change));
    }
    const auto terms = instance.law->stochastic(instance.values);
    if (!terms.empty()) noises_.emplace_back(terms, key(1));
    laws_.push_back({instance.law, instance.values});
  }
  for (const EmpiricalTerm& term : model.unexplained) {
    if (term.axes[axis]) unexplained_.push_back(term);
  }
}

void AxisEffects::advance(const Drivers& now, double dt_s) {
  drift_dps_ = 0.0;
  noise_factor_ = 1.0;
  for (const auto& response : responses_) drift_dps_ += response->at(now);
  for (const EmpiricalTerm& term : unexplained_) {
    if (!is_line(term)) drift_dps_ += rig::drift_dps(term, now);
    noise_factor_ *= rig::noise_factor(term, now);
  }
  for (OuNoise& noise : noises_) drift_dps_ += noise.advance(dt_s);
  for (const Coded& coded : laws_) noise_factor_ *= coded.law->noise_factor(coded.values, now);
  for (const auto& change : changes_) change->now(now);
}

void AxisEffects::add(std::span<const double> t_s, double sigma_dps, std::span<double> rate_dps) {
  for (const auto& change : changes_) change->add(t_s, sigma_dps, rate_dps);
  for (const EmpiricalTerm& term : unexplained_) {
    if (!is_line(term)) continue;
    Drivers now;
    for (std::size_t i = 0; i < t_s.size(); ++i) {
      now.t_s = t_s[i];
      rate_dps[i] += rig::drift_dps(term, now);
    }
  }
}

void AxisEffects::convert(std::span<const double> exact_lsb, std::span<double> codes,
                          double lsb_dps) const {
  for (const Coded& coded : laws_) {
    for (std::size_t i = 0; i < codes.size(); ++i) {
      codes[i] = coded.law->code(coded.values, exact_lsb[i], codes[i], lsb_dps);
    }
  }
}

void AxisEffects::change(std::span<double> codes) {
  for (const auto& change : changes_) change->change(codes);
}

void AxisEffects::lose(std::span<std::uint8_t> lost) {
  for (const auto& change : changes_) change->lose(lost);
}

BoardEffects::BoardEffects(std::span<const Instance> instances, std::uint32_t board) {
  for (const Instance& instance : instances) {
    if (!felt_by(instance, board)) continue;
    instances_.push_back(instance);
    if (auto reading = instance.law->board_reading(instance.values)) {
      readings_.push_back(std::move(reading));
    }
  }
}

std::array<double, 3> BoardEffects::specific_force_g(const Drivers& now) const {
  std::array<double, 3> force{0.0, 0.0, 1.0};
  for (const Instance& instance : instances_) {
    const auto tilt = instance.law->tilt_g(instance.values, now);
    for (std::size_t axis = 0; axis < 3; ++axis) force[axis] += tilt[axis];
  }
  return force;
}

double BoardEffects::sensor_error_c(const Drivers& now) {
  double error_c = 0.0;
  for (const auto& reading : readings_) error_c += reading->at(now);
  return error_c;
}

std::vector<Line> BoardEffects::lines(const Drivers& now) const {
  std::vector<Line> all;
  for (const Instance& instance : instances_) {
    const auto some = instance.law->lines(instance.values, now);
    all.insert(all.end(), some.begin(), some.end());
  }
  return all;
}

}  // namespace gyrocal::rig
