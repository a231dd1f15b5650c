#include "compensation/drift/smoothing_spline.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "compensation/values/assert.h"

namespace gyrocal {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr Index points_min = 4;

/// Symmetric matrix of bandwidth 2 as its diagonals: below1(i) couples i and i + 1.
struct Pentadiagonal {
  VectorXd diagonal, below1, below2;
};

/// What does not change with lambda: with Q the second differences and R the Gram matrix of the
/// hat functions, the second derivatives solve (R + lambda Q' W^-1 Q) second = Q' y.
struct SplineProblem {
  VectorXd step;             // n - 1
  VectorXd inverse_weights;  // n
  VectorXd y;
  VectorXd differences;  // Q' y, n - 2
  Eigen::MatrixXd q;     // (n - 2) x 3: the entries of column i of Q at rows i, i + 1, i + 2
  Pentadiagonal gram, roughness;
};

SplineProblem problem(const Eigen::Ref<const VectorXd>& x, const Eigen::Ref<const VectorXd>& y,
                      const VectorXd& weights) {
  const Index n = x.size();
  const Index m = n - 2;
  SplineProblem p;
  p.step = x.tail(n - 1) - x.head(n - 1);
  p.inverse_weights =
      weights.size() == 0 ? VectorXd::Ones(n).eval() : weights.cwiseInverse().eval();
  p.y = y;
  p.q.resize(m, 3);
  p.differences.resize(m);
  p.gram = {VectorXd(m), VectorXd::Zero(m), VectorXd::Zero(m)};
  p.roughness = {VectorXd(m), VectorXd::Zero(m), VectorXd::Zero(m)};
  for (Index i = 0; i < m; ++i) {
    const double left = 1 / p.step(i);
    const double right = 1 / p.step(i + 1);
    p.q.row(i) << left, -left - right, right;
    p.differences(i) = p.q.row(i) * y.segment(i, 3);
    p.gram.diagonal(i) = (p.step(i) + p.step(i + 1)) / 3;
    if (i + 1 < m) p.gram.below1(i) = p.step(i + 1) / 6;
  }
  const auto& v = p.inverse_weights;
  for (Index i = 0; i < m; ++i) {
    p.roughness.diagonal(i) = p.q.row(i).cwiseAbs2() * v.segment(i, 3);
    if (i + 1 < m) {
      p.roughness.below1(i) =
          p.q(i, 1) * v(i + 1) * p.q(i + 1, 0) + p.q(i, 2) * v(i + 2) * p.q(i + 1, 1);
    }
    if (i + 2 < m) p.roughness.below2(i) = p.q(i, 2) * v(i + 2) * p.q(i + 2, 0);
  }
  return p;
}

/// Splines of one problem for any lambda. Its memory serves every lambda: choosing one takes some
/// sixty splines, and holding every point out in turn takes that for each.
class Smoother {
 public:
  explicit Smoother(SplineProblem problem) : p_(std::move(problem)) {
    const Index m = p_.differences.size();
    for (Pentadiagonal* bands : {&system_, &inverse_}) {
      *bands = {VectorXd::Zero(m), VectorXd::Zero(m), VectorXd::Zero(m)};
    }
    inner_.resize(m);
    values_.resize(p_.y.size());
  }

  [[nodiscard]] Spline spline(double lambda) {
    smooth(lambda);
    Spline spline;
    spline.lambda = lambda;
    spline.values = values_;
    spline.second = VectorXd::Zero(p_.y.size());
    spline.second.segment(1, inner_.size()) = inner_;
    spline.trace = trace_;
    return spline;
  }

  [[nodiscard]] double chosen_lambda();

 private:
  void smooth(double lambda);
  void factorise();
  void solve();
  void invert();
  [[nodiscard]] double generalized_cross_validation(double log_lambda);

  SplineProblem p_;
  Pentadiagonal system_;   ///< gram + lambda roughness, then its L D L'
  Pentadiagonal inverse_;  ///< the five central diagonals of the system's inverse
  VectorXd inner_;         ///< second derivatives at the inner points
  VectorXd values_;        ///< of the spline at the points
  double trace_ = 0;       ///< of the smoother y -> values
};

/// L D L' in place: the diagonal becomes 1/D, the bands those of the unit lower L.
void Smoother::factorise() {
  Pentadiagonal& a = system_;
  const Index m = a.diagonal.size();
  double scaled1 = 0;  // below1(i - 1) D(i - 1)
  double scaled2 = 0;  // below2(i - 1) D(i - 1)
  double before2 = 0;  // below2(i - 2) D(i - 2)
  for (Index i = 0; i < m; ++i) {
    double d = a.diagonal(i);
    double next1 = a.below1(i);
    if (i >= 1) {
      d -= a.below1(i - 1) * scaled1;
      next1 -= a.below1(i - 1) * scaled2;
    }
    if (i >= 2) d -= a.below2(i - 2) * before2;
    before2 = scaled2;
    scaled1 = next1;
    scaled2 = a.below2(i);
    a.diagonal(i) = 1 / d;
    a.below1(i) = scaled1 * a.diagonal(i);
    a.below2(i) = scaled2 * a.diagonal(i);
  }
}

void Smoother::solve() {
  const Index m = inner_.size();
  inner_ = p_.differences;
  for (Index i = 0; i < m; ++i) {
    if (i >= 1) inner_(i) -= system_.below1(i - 1) * inner_(i - 1);
    if (i >= 2) inner_(i) -= system_.below2(i - 2) * inner_(i - 2);
  }
  inner_.array() *= system_.diagonal.array();
  for (Index i = m; i-- > 0;) {
    if (i + 1 < m) inner_(i) -= system_.below1(i) * inner_(i + 1);
    if (i + 2 < m) inner_(i) -= system_.below2(i) * inner_(i + 2);
  }
}

/// From the last row up.
void Smoother::invert() {
  Pentadiagonal& b = inverse_;
  const Index m = b.diagonal.size();
  for (Index i = m; i-- > 0;) {
    const double u = i + 1 < m ? system_.below1(i) : 0;
    const double v = i + 2 < m ? system_.below2(i) : 0;
    const double d1 = i + 1 < m ? b.diagonal(i + 1) : 0;
    const double d2 = i + 2 < m ? b.diagonal(i + 2) : 0;
    const double e1 = i + 2 < m ? b.below1(i + 1) : 0;
    if (i + 1 < m) b.below1(i) = -u * d1 - v * e1;
    if (i + 2 < m) b.below2(i) = -u * e1 - v * d2;
    b.diagonal(i) = system_.diagonal(i) - u * b.below1(i) - v * b.below2(i);
  }
}

void Smoother::smooth(double lambda) {
  system_.diagonal = p_.gram.diagonal + lambda * p_.roughness.diagonal;
  system_.below1 = p_.gram.below1 + lambda * p_.roughness.below1;
  system_.below2 = p_.gram.below2 + lambda * p_.roughness.below2;
  factorise();
  solve();
  values_ = p_.y;
  for (Index i = 0; i < inner_.size(); ++i) {
    for (Index j = 0; j < 3; ++j) {
      values_(i + j) -= lambda * p_.inverse_weights(i + j) * p_.q(i, j) * inner_(i);
    }
  }
  // n - trace = lambda tr(B Q' W^-1 Q), where B is the inverse of the system.
  invert();
  const double removed = inverse_.diagonal.dot(p_.roughness.diagonal) +
                         2 * inverse_.below1.dot(p_.roughness.below1) +
                         2 * inverse_.below2.dot(p_.roughness.below2);
  trace_ = static_cast<double>(p_.y.size()) - lambda * removed;
}

/// With the trace weighed 1.4 (Kim and Gu 2004): on tens of points the plain score likes to
/// interpolate.
double Smoother::generalized_cross_validation(double log_lambda) {
  smooth(std::exp(log_lambda));
  const double squares = ((values_ - p_.y).array().square() / p_.inverse_weights.array()).sum();
  const double left = 1 - 1.4 * trace_ / static_cast<double>(p_.y.size());
  if (left <= 0) return std::numeric_limits<double>::infinity();
  return squares / (left * left);
}

/// From a spline of nearly n parameters to a straight line, in the data's own scale.
double Smoother::chosen_lambda() {
  const double natural =
      std::log(p_.gram.diagonal.sum() / p_.roughness.diagonal.sum());  // both parts weigh the same
  constexpr double reach = 18;                                         // e^18 either way
  constexpr int cells = 36;
  const double cell = 2 * reach / cells;
  const auto score = [&](double offset) { return generalized_cross_validation(natural + offset); };
  int best_cell = 0;
  double best_score = std::numeric_limits<double>::infinity();
  const auto look_at = [&](int at) {
    if (at < 0 || at > cells) return;
    if (const double found = score(-reach + at * cell); found < best_score) {
      best_cell = at;
      best_score = found;
    }
  };
  // The score turns within several e-folds: every third place shows where, its neighbours the rest.
  for (int at = 0; at <= cells; at += 3) look_at(at);
  for (const int near = best_cell; const int off : {-2, -1, 1, 2}) look_at(near + off);
  const double best = -reach + best_cell * cell;
  constexpr double golden = 0.6180339887498949;
  double low = best - cell;
  double high = best + cell;
  double left = high - golden * (high - low);
  double right = low + golden * (high - low);
  double left_score = score(left);
  double right_score = score(right);
  for (int i = 0; i < 24; ++i) {  // 1e-5 of a cell
    if (left_score <= right_score) {
      high = right;
      right = left;
      right_score = left_score;
      left = high - golden * (high - low);
      left_score = score(left);
    } else {
      low = left;
      left = right;
      left_score = right_score;
      right = low + golden * (high - low);
      right_score = score(right);
    }
  }
  return std::exp(natural + 0.5 * (low + high));
}

}  // namespace

Result<Spline> fit_smoothing_spline(const Eigen::Ref<const VectorXd>& x,
                                    const Eigen::Ref<const VectorXd>& y, const VectorXd& weights,
                                    std::optional<double> lambda) {
  GYROCAL_ASSERT(x.size() == y.size() && (weights.size() == 0 || weights.size() == x.size()));
  if (x.size() < points_min) {
    return fail(
        Errc::too_few_points,
        fmt::format("a smoothing spline needs at least {} points, got {}", points_min, x.size()),
        "measure more setpoints");
  }
  if (!x.allFinite() || !y.allFinite() || !weights.allFinite()) {
    return fail(Errc::not_finite, "a point to smooth is NaN or infinite", "remove or repeat it");
  }
  Smoother smoother(problem(x, y, weights));
  Spline spline = smoother.spline(lambda ? *lambda : smoother.chosen_lambda());
  spline.knots = x;
  return spline;
}

double value_at(const Spline& s, double x) {
  const Index n = s.knots.size();
  const auto* begin = s.knots.data();
  const Index i = std::upper_bound(begin + 1, begin + n - 1, x) - begin - 1;
  const double h = s.knots(i + 1) - s.knots(i);
  const double slope = (s.values(i + 1) - s.values(i)) / h;
  if (x < s.knots(0)) return s.values(0) + (slope - h * s.second(1) / 6) * (x - s.knots(0));
  if (x > s.knots(n - 1)) {
    return s.values(n - 1) + (slope + h * s.second(n - 2) / 6) * (x - s.knots(n - 1));
  }
  const double right = (x - s.knots(i)) / h;
  const double left = 1 - right;
  return left * s.values(i) + right * s.values(i + 1) +
         h * h / 6 *
             ((left * left * left - left) * s.second(i) +
              (right * right * right - right) * s.second(i + 1));
}

}  // namespace gyrocal
