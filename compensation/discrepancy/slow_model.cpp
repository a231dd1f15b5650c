#include <algorithm>
#include <cmath>

#include "compensation/discrepancy/slow_search.h"
#include "compensation/values/assert.h"

namespace gyrocal {
namespace {

constexpr Eigen::Index cubic_columns = 4;

double unit_of(double die_c) {
  return (die_c - rig::CubicBias::center_c) / rig::CubicBias::half_span_c;
}

}  // namespace

SlowModel::SlowModel(const SlowStream& stream, const Track& track)
    : stream_(&stream),
      track_(&track),
      known_(track.record.size(), 0.0),
      known_bins_(Eigen::VectorXd::Zero(stream.size())),
      y_(stream.y_dps()) {
  refit();
}

void SlowModel::set_terms(std::vector<SlowTerm> terms) { terms_ = std::move(terms); }

void SlowModel::set_known(const std::vector<double>& course) {
  GYROCAL_ASSERT(course.size() == track_->record.size());
  known_ = course;
}

void SlowModel::set_shapes(std::vector<std::vector<double>> courses) {
  shapes_ = std::move(courses);
}

void SlowModel::set_known_bins(const Eigen::VectorXd& bins) { known_bins_ = bins; }

void SlowModel::set_noise(const NoiseFamily& family) { noise_ = family; }

Eigen::VectorXd SlowModel::column(const rig::Law& law, const std::vector<double>& values) const {
  return stream_->bin(rig::drift_over(law, values, bias_, track_->record));
}

void SlowModel::build_design() {
  y_ = stream_->y_dps() - stream_->bin(known_) - known_bins_;
  std::vector<Eigen::VectorXd> columns;
  std::vector<double> power(track_->record.size(), 1.0);
  for (Eigen::Index degree = 0; degree < cubic_columns; ++degree) {
    columns.push_back(stream_->bin(power));
    for (std::size_t i = 0; i < power.size(); ++i) {
      power[i] *= unit_of(track_->record[i].die_c);
    }
  }
  for (const SlowTerm& term : terms_) {
    if (!term.law->info.linear) {
      y_ -= column(*term.law, term.values);
      continue;
    }
    std::vector<double> unit = term.values;
    unit[0] = 1;
    columns.push_back(column(*term.law, unit));
  }
  for (const auto& course : shapes_) columns.push_back(stream_->bin(course));
  design_.resize(y_.size(), static_cast<Eigen::Index>(columns.size()));
  for (std::size_t i = 0; i < columns.size(); ++i) {
    design_.col(static_cast<Eigen::Index>(i)) = columns[i];
  }
}

void SlowModel::refit() {
  // Twice where a term bends the cubic itself: the first pass gives it the bias it needs.
  const bool bends = std::any_of(terms_.begin(), terms_.end(),
                                 [](const SlowTerm& term) { return !term.law->info.linear; });
  for (int pass = 0; pass < (bends ? 3 : 1); ++pass) {
    build_design();
    fit_ = fit_noise(stream_->grid(), y_, design_, noise_);
    for (Eigen::Index i = 0; i < cubic_columns; ++i) {
      bias_.dps[static_cast<std::size_t>(i)] = fit_.coefficients(i);
    }
  }
  Eigen::Index next = cubic_columns;
  for (SlowTerm& term : terms_) {
    if (!term.law->info.linear) continue;
    term.values[0] = fit_.coefficients(next);
    term.amplitude_sd = fit_.standard_error(next);
    ++next;
  }
  fit_free_ = noise_.flicker && noise_.walk
                  ? fit_
                  : fit_noise(stream_->grid(), y_, design_, {.flicker = true, .walk = true});
  if (fit_free_.log_likelihood < fit_.log_likelihood) fit_free_ = fit_;
}

std::vector<double> SlowModel::prediction() const {
  std::vector<double> course = known_;
  for (std::size_t i = 0; i < course.size(); ++i) {
    course[i] += bias_.at(track_->record[i].die_c);
  }
  for (const SlowTerm& term : terms_) {
    const auto added = rig::drift_over(*term.law, term.values, bias_, track_->record);
    for (std::size_t i = 0; i < course.size(); ++i) course[i] += added[i];
  }
  const Eigen::Index first = design_.cols() - static_cast<Eigen::Index>(shapes_.size());
  for (std::size_t k = 0; k < shapes_.size(); ++k) {
    const double amplitude = fit_.coefficients(first + static_cast<Eigen::Index>(k));
    for (std::size_t i = 0; i < course.size(); ++i) course[i] += amplitude * shapes_[k][i];
  }
  return course;
}

}  // namespace gyrocal
