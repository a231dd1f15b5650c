#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "compensation/discrepancy/segments.h"
#include "compensation/discrepancy/slow_noise.h"
#include "compensation/discrepancy/track.h"
#include "compensation/values/records.h"

namespace gyrocal {

/// The monitor rows as bins of some twenty seconds, and the way from a course on the track to the
/// same bins.
class SlowStream {
 public:
  /// @param rows  chosen monitor rows (indices, ascending), each with a gyro mean.
  /// @param noise_factor  at the track's instants: by how much white noise exceeds its reference.
  SlowStream(const Session& session, std::span<const std::size_t> rows, const Track& track,
             double bin_s, std::span<const double> noise_factor);

  [[nodiscard]] const SlowGrid& grid() const { return grid_; }
  [[nodiscard]] const Eigen::VectorXd& y_dps() const { return y_dps_; }
  [[nodiscard]] Eigen::Index size() const { return y_dps_.size(); }

  /// Means over each bin's rows of a course given at the track's instants.
  [[nodiscard]] Eigen::VectorXd bin(std::span<const double> course) const;

  // The rows the bins are made of, for what changes within a bin.
  [[nodiscard]] const SlowGrid& row_grid() const { return row_grid_; }
  [[nodiscard]] const Eigen::VectorXd& row_y_dps() const { return row_y_dps_; }
  /// A course at each row.
  [[nodiscard]] Eigen::VectorXd at_rows(std::span<const double> course) const;
  /// Each bin's values (a row of `bins` each) at all of its rows.
  [[nodiscard]] Eigen::MatrixXd spread_to_rows(const Eigen::MatrixXd& bins) const;
  /// Means over each bin's rows.
  [[nodiscard]] Eigen::VectorXd bin_rows(const Eigen::VectorXd& rows) const;

 private:
  struct Tap {
    std::uint32_t bin;
    std::uint32_t left;
    double left_share;
    double right_share;

    [[nodiscard]] double of(std::span<const double> course) const {
      return left_share * course[left] + right_share * course[left + 1];
    }
  };
  SlowGrid grid_, row_grid_;
  Eigen::VectorXd y_dps_, row_y_dps_;
  Eigen::VectorXd rows_in_bin_;
  std::vector<Tap> taps_;
};

inline constexpr double lone_outlier_sd_usual = 8;

/// Rows a fit may use: with a gyro mean, not kept out, and not one that stands alone far from its
/// neighbours (a glitch in one sample moves a five-second mean by dozens of its deviations).
struct RowChoice {
  std::vector<std::size_t> rows;
  std::int64_t lone_outliers = 0;
};
/// @param lone_outlier_sd  how far off a row must stand to be left out.
[[nodiscard]] RowChoice training_rows(const Session& session, std::span<const Segment> segments,
                                      double lone_outlier_sd = lone_outlier_sd_usual);

/// White noise of a one-second mean, from neighbouring rows' differences: blind to everything slow
/// and to glitches [deg/s].
[[nodiscard]] double row_white_sd_dps(const Session& session, std::span<const std::size_t> rows);

/// Bin width [s] for a session: twenty seconds or the monitor's interval, more for long records,
/// so that a fit sees at most some 2500 bins; less for a short one, so that it sees some 48.
[[nodiscard]] double bin_width_s(const Session& session);

/// A course at single instants, on straight lines between the track's.
[[nodiscard]] double course_at(const Track& track, std::span<const double> course, double t_s);

}  // namespace gyrocal
