#include "tests/hidden_effects/rivals.h"

#include <algorithm>
#include <cmath>

namespace hidden {
namespace {

class Shapes {
 public:
  Shapes(std::string name, Eigen::Index bins) : name_(std::move(name)), bins_(bins) {}
  void add(const Series& series) { columns_.push_back(binned(series, bins_)); }
  RivalClass done() const {
    RivalClass rival;
    rival.name = name_;
    rival.columns.resize(bins_, static_cast<Eigen::Index>(columns_.size()));
    for (std::size_t k = 0; k < columns_.size(); ++k) {
      rival.columns.col(static_cast<Eigen::Index>(k)) = columns_[k];
    }
    return rival;
  }

 private:
  std::string name_;
  Eigen::Index bins_;
  std::vector<Eigen::VectorXd> columns_;
};

Series mapped(const Trajectory& over, const std::function<double(std::size_t)>& value) {
  Series series(over.seconds());
  for (std::size_t i = 0; i < series.size(); ++i) series[i] = value(i);
  return series;
}

Series low_pass(const Series& input, double tau_s) {
  Series out(input.size(), input.front());
  for (std::size_t i = 1; i < input.size(); ++i) {
    out[i] = out[i - 1] + (input[i] - out[i - 1]) / (tau_s + 0.5);
  }
  return out;
}

RivalClass lags(const Trajectory& over, const Baseline& baseline, Eigen::Index bins) {
  Shapes shapes("thermal_lag", bins);
  for (double tau_s : {15.0, 60.0, 150.0, 400.0, 900.0}) {
    const Series late_c = low_pass(over.die_c, tau_s);
    shapes.add(
        mapped(over, [&](std::size_t i) { return baseline(late_c[i]) - baseline(over.die_c[i]); }));
  }
  RivalClass rival = shapes.done();
  rival.least_share = 0.0;  // a share of one lag is about a shorter lag
  rival.greatest_share = 1.0;
  return rival;
}

RivalClass plays(const Trajectory& over, Eigen::Index bins) {
  Shapes shapes("thermal_hysteresis", bins);
  for (double radius_c : {0.4, 0.8, 1.5, 2.5, 4.0, 6.0, 10.0}) {
    double play = over.die_c.front();
    shapes.add(mapped(over, [&](std::size_t i) {
      play = std::clamp(play, over.die_c[i] - radius_c, over.die_c[i] + radius_c);
      return over.die_c[i] - play;
    }));
  }
  double direction = 0.0;
  double turned_c = over.die_c.front();
  shapes.add(mapped(over, [&](std::size_t i) {
    const double moved_c = over.die_c[i] - turned_c;
    if (moved_c * direction >= 0.0) turned_c = over.die_c[i];
    if (std::abs(moved_c) > 0.5) {
      direction = moved_c > 0.0 ? 1.0 : -1.0;
      turned_c = over.die_c[i];
    }
    return direction;
  }));
  return shapes.done();
}

RivalClass warm_ups(const Trajectory& over, Eigen::Index bins) {
  Shapes shapes("self_heating", bins);
  for (double tau_s : {100.0, 250.0, 500.0, 1000.0, 2000.0}) {
    shapes.add(
        mapped(over, [&](std::size_t i) { return std::exp(-static_cast<double>(i) / tau_s); }));
  }
  return shapes.done();
}

RivalClass ages(const Trajectory& over, Eigen::Index bins) {
  Shapes shapes("aging_drift", bins);
  shapes.add(mapped(over, [&](std::size_t i) { return static_cast<double>(i); }));
  for (double tau_s : {3600.0, 14400.0, 50000.0}) {
    shapes.add(
        mapped(over, [&](std::size_t i) { return std::log1p(static_cast<double>(i) / tau_s); }));
  }
  return shapes.done();
}

RivalClass jumps(const Trajectory& over, Eigen::Index bins) {
  Shapes shapes("bias_jump", bins);
  const std::size_t places = 80;
  for (std::size_t k = 1; k < places; ++k) {
    const std::size_t at = over.seconds() * k / places;
    shapes.add(mapped(over, [&](std::size_t i) { return i >= at ? 1.0 : 0.0; }));
  }
  return shapes.done();
}

RivalClass crossings(const Trajectory& over, Eigen::Index bins) {
  Shapes shapes("mode_crossing", bins);
  for (double width_c : {0.7, 1.5, 3.0, 5.0}) {
    for (double center_c = -12.0; center_c <= 52.0; center_c += std::max(1.0, 0.7 * width_c)) {
      const auto u = [&](std::size_t i) { return (over.die_c[i] - center_c) / width_c; };
      shapes.add(mapped(over, [&](std::size_t i) { return 1.0 / (1.0 + u(i) * u(i)); }));
      shapes.add(mapped(over, [&](std::size_t i) { return u(i) / (1.0 + u(i) * u(i)); }));
      shapes.add(mapped(over, [&](std::size_t i) { return std::sqrt(1.0 + u(i) * u(i)); }));
    }
  }
  return shapes.done();
}

RivalClass films(const Trajectory& over, Eigen::Index bins) {
  Shapes shapes("condensation_step", bins);
  for (double dew_c = -5.0; dew_c <= 12.0; dew_c += 1.0) {
    for (double off_s : {900.0, 2000.0, 3600.0}) {
      double wet = 0.0;
      shapes.add(mapped(over, [&](std::size_t i) {
        const bool wetting = over.board_c[i] < dew_c && dew_c < over.air_c[i];
        wet += wetting ? (1.0 - wet) / 120.0 : -wet / off_s;
        return wet;
      }));
    }
  }
  return shapes.done();
}

RivalClass relaxations(const Trajectory& over, Eigen::Index bins) {
  Shapes shapes("stress_relaxation", bins);
  for (double tau_s : {600.0, 1200.0, 2400.0, 4800.0, 9000.0, 14400.0}) {
    double strain = 0.0;
    shapes.add(mapped(over, [&](std::size_t i) {
      strain += over.rate_c_per_min[i] / 60.0 - strain / tau_s;
      return strain;
    }));
  }
  return shapes.done();
}

}  // namespace

Eigen::VectorXd binned(const Series& series, Eigen::Index bins) {
  Eigen::VectorXd means = Eigen::VectorXd::Zero(bins);
  Eigen::VectorXd counts = Eigen::VectorXd::Zero(bins);
  const auto n = static_cast<Eigen::Index>(series.size());
  for (Eigen::Index i = 0; i < n; ++i) {
    const Eigen::Index bin = i * bins / n;
    means(bin) += series[static_cast<std::size_t>(i)];
    counts(bin) += 1.0;
  }
  return means.cwiseQuotient(counts.cwiseMax(1.0));
}

std::vector<RivalClass> textbook_rivals(const Trajectory& over, const Baseline& baseline,
                                        Eigen::Index bins) {
  Shapes rate("temperature_rate", bins);
  rate.add(over.rate_c_per_min);
  return {rate.done(),           lags(over, baseline, bins), plays(over, bins),
          warm_ups(over, bins),  ages(over, bins),           jumps(over, bins),
          crossings(over, bins), films(over, bins),          relaxations(over, bins)};
}

}  // namespace hidden
