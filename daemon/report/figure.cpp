#include "daemon/report/figure.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace gyrocal::report {
namespace {

/// Okabe and Ito's colours, told apart by the colour-blind and in grey.
constexpr std::array colours{"#0072B2", "#D55E00", "#009E73", "#CC79A7",
                             "#000000", "#E69F00", "#56B4E9"};

/// In gnuplot's single quotes nothing is special but the quote itself, which becomes an apostrophe:
/// doubled, as its manual has it, it is not understood at a text's start. Control characters end
/// lines and become blanks.
std::string quoted(const std::string& text) {
  std::string result(1, '\'');
  for (const char c : text) {
    if (c == '\'') {
      result += "\u2019";
    } else {
      result += static_cast<unsigned char>(c) < ' ' ? ' ' : c;
    }
  }
  result += '\'';
  return result;
}

std::string datum(double value) {
  return std::isfinite(value) ? fmt::format("{:.7g}", value) : "NaN";
}

std::string data_of(const Curve& curve, std::size_t number) {
  std::string text = fmt::format("$curve{} << END_OF_CURVE\n", number);
  for (std::size_t i = 0; i < curve.x.size(); ++i) {
    text += fmt::format("{} {}", datum(curve.x[i]), datum(curve.y[i]));
    if (curve.style == Curve::Style::band) text += fmt::format(" {}", datum(curve.upper[i]));
    text += '\n';
  }
  return text + "END_OF_CURVE\n";
}

std::string drawing_of(const Curve& curve, std::size_t number) {
  const auto* const colour = colours[static_cast<std::size_t>(curve.colour) % colours.size()];
  const std::string title =
      curve.title.empty() ? "notitle" : fmt::format("title {}", quoted(curve.title));
  switch (curve.style) {
    case Curve::Style::points:
      return fmt::format("$curve{} using 1:2 with points pt 7 ps {} lc rgb '{}' {}", number,
                         curve.x.size() < 200 ? 0.7 : 0.35, colour, title);
    case Curve::Style::band:
      return fmt::format(
          "$curve{} using 1:2:3 with filledcurves fs transparent solid 0.2 noborder lc rgb '{}' {}",
          number, colour, title);
    case Curve::Style::line:
      break;
  }
  return fmt::format("$curve{} using 1:2 with lines lw 1.4 lc rgb '{}' {}", number, colour, title);
}

}  // namespace

Curve thinned(const Curve& curve, std::size_t columns) {
  const std::size_t n = curve.x.size();
  if (curve.style != Curve::Style::line || n <= 2 * columns || curve.x.back() <= curve.x.front()) {
    return curve;
  }
  Curve few = curve;
  few.x.clear();
  few.y.clear();
  const auto keep = [&](std::size_t i) {
    few.x.push_back(curve.x[i]);
    few.y.push_back(curve.y[i]);
  };
  const double width = (curve.x.back() - curve.x.front()) / static_cast<double>(columns);
  for (std::size_t begin = 0; begin < n;) {
    std::size_t end = begin;
    std::size_t least = begin, greatest = begin;
    while (end < n && curve.x[end] < curve.x[begin] + width) {
      if (!(curve.y[end] >= curve.y[least])) least = end;
      if (!(curve.y[end] <= curve.y[greatest])) greatest = end;
      ++end;
    }
    keep(std::min(least, greatest));
    if (least != greatest) keep(std::max(least, greatest));
    begin = std::max(end, begin + 1);
  }
  return few;
}

std::string gnuplot_script(const Figure& figure) {
  std::string script =
      "set terminal svg size 900,420 dynamic noenhanced font 'sans-serif,13' background '#ffffff'\n"
      "set encoding utf8\nset grid lc rgb '#dddddd'\nset border 3 lc rgb '#555555'\n"
      "set tics nomirror\nset key above\nset autoscale xfix\n";
  script += fmt::format("set title {} noenhanced\nset xlabel {}\nset ylabel {}\n",
                        quoted(figure.title), quoted(figure.x_label), quoted(figure.y_label));
  if (figure.log_x) script += "set logscale x\n";
  if (figure.log_y) script += "set logscale y\n";
  for (const auto& [from, to] : figure.marked) {
    script += fmt::format(
        "set object rectangle from first {0:.7g}, graph 0 to first {1:.7g}, graph 1 behind "
        "fillcolor rgb '#eeeeee' fillstyle solid noborder\n",
        from, to);
  }
  std::string drawings;
  for (std::size_t i = 0; i < figure.curves.size(); ++i) {
    const Curve curve = thinned(figure.curves[i]);
    if (curve.x.empty()) continue;
    script += data_of(curve, i);
    drawings += drawings.empty() ? "plot " : ", ";
    drawings += drawing_of(curve, i);
  }
  // A figure with nothing in it still has its axes.
  script += drawings.empty() ? "set key off\nplot [0:1] [0:1] NaN" : drawings;
  script += '\n';
  return script;
}

}  // namespace gyrocal::report
