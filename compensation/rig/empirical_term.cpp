#include "compensation/rig/empirical_term.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace gyrocal::rig {
namespace {

struct Named {
  EmpiricalDriver driver;
  std::string_view name;
};
constexpr std::array<Named, 6> named_drivers{{
    {EmpiricalDriver::campaign_time, "t_s"},
    {EmpiricalDriver::time_on, "t_on_s"},
    {EmpiricalDriver::die, "die_c"},
    {EmpiricalDriver::die_rate, "die_rate_c_per_min"},
    {EmpiricalDriver::chamber_minus_board, "chamber_minus_board_c"},
    {EmpiricalDriver::phase, "phase"},
}};

double on_curve(const std::vector<double>& at, const std::vector<double>& values, double x) {
  const auto above = std::upper_bound(at.begin(), at.end(), x);
  if (above == at.begin()) return values.front();
  if (above == at.end()) return values.back();
  const auto i = static_cast<std::size_t>(above - at.begin());
  const double part = (x - at[i - 1]) / (at[i] - at[i - 1]);
  return values[i - 1] + part * (values[i] - values[i - 1]);
}

}  // namespace

std::string_view name_of(EmpiricalDriver driver) {
  for (const Named& n : named_drivers) {
    if (n.driver == driver) return n.name;
  }
  return "";
}

Result<EmpiricalDriver> driver_named(std::string_view name) {
  std::string known;
  for (const Named& n : named_drivers) {
    if (n.name == name) return n.driver;
    known += (known.empty() ? "known: " : ", ") + std::string(n.name);
  }
  return fail(Errc::unknown_name, fmt::format("unknown driver \"{}\"", name), known);
}

double driver_value(const EmpiricalTerm& term, const Drivers& now) {
  switch (term.driver) {
    case EmpiricalDriver::campaign_time:
      return now.t_s;
    case EmpiricalDriver::time_on:
      return now.t_on_s;
    case EmpiricalDriver::die:
      return now.die_c;
    case EmpiricalDriver::die_rate:
      return now.die_rate_c_per_min;
    case EmpiricalDriver::chamber_minus_board:
      return now.chamber_c - now.board_c;
    case EmpiricalDriver::phase: {
      const double turns = now.t_s / term.period_s;
      return turns - std::floor(turns);
    }
  }
  return 0.0;
}

double drift_dps(const EmpiricalTerm& term, const Drivers& now) {
  return term.dps.empty() ? 0.0 : on_curve(term.at, term.dps, driver_value(term, now));
}

double noise_factor(const EmpiricalTerm& term, const Drivers& now) {
  return term.noise_factor.empty() ? 1.0
                                   : on_curve(term.at, term.noise_factor, driver_value(term, now));
}

bool is_line(const EmpiricalTerm& term) {
  constexpr double period_s_max = 20;  // a bin of the slow stream
  return term.driver == EmpiricalDriver::phase && term.period_s < period_s_max;
}

Result<void> check(const EmpiricalTerm& term) {
  const auto wrong = [](const char* what) {
    return fail(Errc::bad_input, fmt::format("unexplained term: {}", what),
                "\"at\" ascending and \"dps\" or \"noise_factor\" of the same length, two knots "
                "or more");
  };
  if (term.at.size() < 2) return wrong("fewer than two knots");
  if (term.dps.empty() == term.noise_factor.empty()) {
    return wrong("either dps or noise_factor is needed");
  }
  const std::vector<double>& values = term.dps.empty() ? term.noise_factor : term.dps;
  if (term.at.size() != values.size()) {
    return wrong(term.dps.empty() ? "at and noise_factor differ in length"
                                  : "at and dps differ in length");
  }
  for (std::size_t i = 0; i < term.at.size(); ++i) {
    if (!std::isfinite(term.at[i]) || !std::isfinite(values[i])) return wrong("not a number");
    if (i > 0 && term.at[i] <= term.at[i - 1]) return wrong("knots do not ascend");
    if (term.dps.empty() && values[i] < 0) return wrong("a noise_factor is negative");
  }
  if (term.driver == EmpiricalDriver::phase && !(term.period_s > 0.0)) {
    return wrong("a phase needs period_s > 0");
  }
  return {};
}

}  // namespace gyrocal::rig
