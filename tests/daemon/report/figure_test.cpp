#include "daemon/report/figure.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "daemon/report/gnuplot.h"

using namespace gyrocal;
using namespace gyrocal::report;

namespace {

Curve line(std::size_t n) {
  Curve curve;
  curve.title = "a line";
  for (std::size_t i = 0; i < n; ++i) {
    curve.x.push_back(double(i));
    curve.y.push_back(std::sin(double(i) / 1000));
  }
  return curve;
}

}  // namespace

TEST_CASE("a thinned line keeps its peaks and its order", "[report]") {
  Curve curve = line(100000);
  curve.y[54321] = 7;
  curve.y[65432] = -7;
  const Curve few = thinned(curve, 500);
  CHECK(few.x.size() <= 1100);
  CHECK(*std::max_element(few.y.begin(), few.y.end()) == 7);
  CHECK(*std::min_element(few.y.begin(), few.y.end()) == -7);
  CHECK(std::is_sorted(few.x.begin(), few.x.end()));
  CHECK(thinned(line(100), 500).x.size() == 100);
}

TEST_CASE("no title or label can become a command", "[report]") {
  Figure figure;
  figure.title = "it's\n!touch /tmp/owned";
  figure.x_label = "`date`";
  figure.curves = {line(3)};
  figure.curves[0].title = "'; system('false'); '";
  const std::string script = gnuplot_script(figure);
  CHECK(script.find("set title 'it\u2019s !touch /tmp/owned'") != std::string::npos);
  CHECK(script.find("title '\u2019; system(\u2019false\u2019); \u2019'") != std::string::npos);
  const auto svg = svg_of(figure).value();
  CHECK(svg.find("it\u2019s !touch") != std::string::npos);
}

TEST_CASE("every kind of curve is drawn, gaps and empty figures too", "[report]") {
  Figure figure{"all", "x", "y", false, true, {{1, 2}}, {line(5), line(5), line(5)}};
  for (Curve& curve : figure.curves) curve.y = {1, 2, NAN, 4, 5};
  figure.curves[1].style = Curve::Style::points;
  figure.curves[2].style = Curve::Style::band;
  figure.curves[2].upper = {2, 3, NAN, 5, 6};
  const auto svg = svg_of(figure).value();
  CHECK(svg.starts_with("<svg"));
  CHECK(svg.ends_with("</svg>"));
  CHECK(svg_of({"nothing", "x", "y", false, false, {}, {}}).value().starts_with("<svg"));
}
