#include "tests/hidden_effects/memory_laws.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace hidden {
namespace {

/// z' = (T'/w)(1 - (1 + sgn(T' z))/2 |z|^1.5): leaves a branch at once, settles on the other after
/// about two widths. Branches at +-1/2.
Series bouc_wen(const Series& die_c, double width_c) {
  Series series(die_c.size(), 0.0);
  double z = 0.0;
  for (std::size_t i = 1; i < die_c.size(); ++i) {
    const double move = (die_c[i] - die_c[i - 1]) / width_c;
    const double pull = move * z > 0.0 ? std::pow(std::abs(z), 1.5) : 0.0;
    z = std::clamp(z + move * (1.0 - pull), -1.0, 1.0);
    series[i] = 0.5 * z;
  }
  return series;
}

/// Relays with their centres spread over the whole range and their half-widths over a factor of
/// about two; scaled so that the two branches of a full loop lie one apart in the middle.
Series preisach(const Series& die_c, double half_width_c, Random random) {
  struct Relay {
    double up_c, down_c, state;
  };
  constexpr double from_c = -22.0;
  constexpr double to_c = 62.0;
  constexpr std::size_t count = 800;
  std::vector<Relay> relays(count);
  double mean_width_c = 0.0;
  for (std::size_t k = 0; k < count; ++k) {
    const double place = (static_cast<double>(k) + 0.5) / static_cast<double>(count);
    const double center_c = from_c + (to_c - from_c) * place;
    const double half_c = half_width_c * std::exp(0.35 * random.normal());
    relays[k] = {center_c + half_c, center_c - half_c, center_c < die_c.front() ? 1.0 : -1.0};
    mean_width_c += half_c / static_cast<double>(count);
  }
  const double gap_per_state = 4.0 * mean_width_c / (to_c - from_c) * static_cast<double>(count);
  Series series(die_c.size(), 0.0);
  double sum = 0.0;
  for (std::size_t i = 0; i < die_c.size(); ++i) {
    for (auto& relay : relays) {
      const double next = die_c[i] >= relay.up_c     ? 1.0
                          : die_c[i] <= relay.down_c ? -1.0
                                                     : relay.state;
      sum += next - relay.state;
      relay.state = next;
    }
    series[i] = -sum / gap_per_state;
  }
  return series;
}

/// Four plays in parallel. A play of radius r lets T - p swing by +-r, so that over 2r each
/// contributes a gap of one.
Series play_spectrum(const Series& die_c, double radius_c) {
  constexpr std::array<double, 4> scale = {0.3, 0.7, 1.2, 2.0};
  constexpr std::array<double, 4> weight = {0.15, 0.35, 0.35, 0.15};
  std::array<double, 4> play{};
  play.fill(die_c.front());
  Series series(die_c.size(), 0.0);
  for (std::size_t i = 0; i < die_c.size(); ++i) {
    for (std::size_t k = 0; k < scale.size(); ++k) {
      const double r_c = radius_c * scale[k];
      play[k] = std::clamp(play[k], die_c[i] - r_c, die_c[i] + r_c);
      series[i] += weight[k] * (die_c[i] - play[k]) / (2.0 * r_c);
    }
  }
  return series;
}

Series water_film(const Trajectory& over, double dew_c, double on_s, double off_s) {
  Series film(over.seconds(), 0.0);
  double cover = 0.0;
  for (std::size_t i = 0; i < film.size(); ++i) {
    const bool wetting = over.board_c[i] < dew_c && dew_c < over.air_c[i];
    cover += wetting ? (cover + 0.05) * (1.0 - cover) / on_s : -std::pow(cover, 0.8) / off_s;
    cover = std::clamp(cover, 0.0, 1.0);
    film[i] = cover;
  }
  return film;
}

Series relaxing(const Series& die_c, const std::vector<std::pair<double, double>>& tau_and_share) {
  Series series(die_c.size(), 0.0);
  for (const auto& [tau_s, share] : tau_and_share) {
    const double keep = std::exp(-1.0 / tau_s);
    const double gain = tau_s * (1.0 - keep);  // exact for a slope that is constant over the second
    double strain_c = 0.0;
    for (std::size_t i = 1; i < die_c.size(); ++i) {
      strain_c = strain_c * keep + (die_c[i] - die_c[i - 1]) * gain;
      series[i] += share * strain_c;
    }
  }
  return series;
}

}  // namespace

SlowLaw thermal_hysteresis(const std::string& form, Random& random) {
  const double width_c = random.log_uniform(1.0, 5.0);
  SlowLaw law{"thermal_hysteresis",
              form,
              "dps",
              "h: half the gap between the heating and the cooling branch",
              false,
              0.002,
              0.2,
              {{"width_c", width_c}},
              {},
              {}};
  // Relays of one part stay where they are however often it is simulated.
  const Random relays(static_cast<std::uint64_t>(random.uniform(0.0, 1e9)));
  law.shape = [=](const Trajectory& over) {
    Series series = form == "bouc_wen"   ? bouc_wen(over.die_c, width_c)
                    : form == "preisach" ? preisach(over.die_c, width_c, relays)
                                         : play_spectrum(over.die_c, width_c);
    for (double& value : series) value *= 2;  // those run from -1/2 to 1/2, h from -h to h
    return series;
  };
  return law;
}

SlowLaw condensation_step(Random& random) {
  const double dew_c = random.uniform(-4.0, 11.0);
  const double on_s = random.uniform(25.0, 45.0);
  const double off_s = random.uniform(900.0, 3000.0);
  SlowLaw law{"condensation_step",
              "logistic_film",
              "dps",
              "bias under a whole film",
              true,
              0.005,
              0.3,
              {{"dew_c", dew_c}, {"growth_s", on_s}, {"drying_s", off_s}},
              {},
              {}};
  law.shape = [=](const Trajectory& over) { return water_film(over, dew_c, on_s, off_s); };
  return law;
}

SlowLaw stress_relaxation(const std::string& form, Random& random) {
  const double tau_s = random.log_uniform(900.0, 9000.0);
  SlowLaw law{"stress_relaxation",
              form,
              "mdps/degC",
              "bias at once after a step of one degree",
              true,
              0.3,
              20.0,
              {{"tau_s", tau_s}},
              {},
              {}};
  const std::vector<std::pair<double, double>> parts =
      form == "stretched"
          ? std::vector<std::pair<double, double>>{{0.4 * tau_s, 0.25},
                                                   {tau_s, 0.5},
                                                   {2.5 * tau_s, 0.25}}
          : std::vector<std::pair<double, double>>{{0.5 * tau_s, 0.6}, {2.0 * tau_s, 0.4}};
  law.shape = [parts](const Trajectory& over) {
    Series series = relaxing(over.die_c, parts);
    for (double& value : series) value *= 1e-3;
    return series;
  };
  return law;
}

}  // namespace hidden
