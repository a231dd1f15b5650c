#pragma once

#include <string>
#include <utility>
#include <vector>

namespace gyrocal::report {

inline constexpr double to_mdps = 1000;  ///< from deg/s

/// What one curve shows. A point whose y is NaN leaves a gap.
struct Curve {
  enum class Style {
    line,
    points,
    band,  ///< the area from `y` to `upper`
  };
  std::string title;  ///< in the key; empty: not there
  Style style = Style::line;
  std::vector<double> x, y;
  std::vector<double> upper;  ///< band only, as many
  int colour = 0;             ///< index into the report's colours, 0 to 6
};

struct Figure {
  std::string title;
  std::string x_label, y_label;  ///< with units
  bool log_x = false, log_y = false;
  std::vector<std::pair<double, double>>
      marked;  ///< ranges of x, shaded: dwells, kept-out segments
  std::vector<Curve> curves;
};

/// At most about 2 * columns points: in each of `columns` equal stretches of x the least and the
/// greatest y stay, so that no peak is lost. Lines only; x ascending.
[[nodiscard]] Curve thinned(const Curve& curve, std::size_t columns = 700);

/// The figure as a gnuplot script that writes one SVG to standard output. Texts are quoted, so
/// that no name can become a command.
[[nodiscard]] std::string gnuplot_script(const Figure& figure);

}  // namespace gyrocal::report
