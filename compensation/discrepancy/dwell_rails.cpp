#include "compensation/discrepancy/dwell_rails.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "compensation/discrepancy/dwell_shape.h"
#include "compensation/discrepancy/gaussian.h"

namespace gyrocal {
namespace {

constexpr double coarse_sd_lsb = 0.5;  // below it quantiles of codes are no Gaussian's
constexpr double pile_share = 0.05;    // of a dwell in one code: more than a tail holds
// Noise of one code and more, its middle no lower than between the last code and the one beside,
// has 2 % three codes further in, and beyond the last code 0.47 times what is in it.
constexpr double far_share = 0.01;
constexpr double beyond_of_pile = 0.4;
constexpr double rest_share = 0.03;

/// The last code that comes more than by chance: a lone glitch beyond is no end.
void find_last_code(std::span<const DwellData> dwells, double lsb, RangeEnd& end) {
  std::map<std::int64_t, double> seen;
  double total = 0;
  for (const DwellData& dwell : dwells) {
    for (const double y : dwell.y_dps) seen[code_of(end.sign * y, lsb)] += 1, total += 1;
  }
  for (auto last = seen.rbegin(); last != seen.rend(); ++last) {
    if (last->second >= std::max(3.0, 1e-5 * total)) {
      end.code = last->first, end.seen = last->second;
      return;
    }
    end.seen_beyond += last->second;
  }
}

/// White noise of a dwell of which the part beyond the code is cut off: from the quantiles of the
/// rest. 0 where too little is left.
double sd_of_the_rest(const DwellData& dwell, double lsb, double sign, std::int64_t code) {
  std::vector<double> values;
  for (const double y : dwell.y_dps) values.push_back(sign * y);
  std::sort(values.begin(), values.end());
  const double edge = (static_cast<double>(code) - 0.5) * lsb;
  const auto off =
      static_cast<double>(std::lower_bound(values.begin(), values.end(), edge) - values.begin());
  const double share = off / static_cast<double>(values.size());
  if (share < rest_share) return 0;
  const double inner = share / 5;
  const double at = values[static_cast<std::size_t>(off / 5)];
  return (edge - at) / (normal_quantile(share) - normal_quantile(inner));
}

std::optional<Pile> pile_of(const DwellData& dwell, double lsb, double sign, std::int64_t code) {
  double on = 0, beside = 0, far = 0;
  for (const double y : dwell.y_dps) {
    const std::int64_t of_sample = code_of(sign * y, lsb);
    on += of_sample == code;
    beside += of_sample == code - 1;
    far += of_sample < code - 2;
  }
  const auto n = static_cast<double>(dwell.y_dps.size());
  if (on <= beside || on <= pile_share * n) return std::nullopt;
  return Pile{on, far > far_share * n, sd_of_the_rest(dwell, lsb, sign, code)};
}

}  // namespace

RangeEnd range_end(std::span<const DwellData> dwells, double lsb, bool upper) {
  RangeEnd end;
  end.sign = upper ? 1 : -1;
  end.piles.resize(dwells.size());
  if (lsb <= 0) return end;
  find_last_code(dwells, lsb, end);
  if (end.seen == 0) return end;
  for (std::size_t d = 0; d < dwells.size(); ++d) {
    end.piles[d] = pile_of(dwells[d], lsb, end.sign, end.code);
  }
  return end;
}

Rail find_rail(std::span<const DwellData> dwells, const RangeEnd& end, double lsb, bool holes) {
  if (end.seen == 0) return {};
  double beyond = 0, on = 0;
  double hidden = 0;    // in dwells that keep to the last code
  double least_sd = 0;  // of those that do not
  bool wide = false;
  for (std::size_t d = 0; d < dwells.size(); ++d) {
    if (const auto& pile = end.piles[d]) {
      (pile->wide ? beyond : hidden) += beyond_of_pile * pile->on;
      wide = wide || pile->wide;
      continue;
    }
    const DwellShape shape = dwell_shape(dwells[d], lsb);
    const double rounded_sd = end.sign > 0 ? shape.below : shape.above;
    if (rounded_sd < coarse_sd_lsb * lsb) return {};
    least_sd = least_sd > 0 ? std::min(least_sd, rounded_sd) : rounded_sd;
    // A few hundred samples tell a spread to some per cent, and a tail hangs on it: the smaller of
    // two views claims less.
    const double sd =
        std::min(std::sqrt(rounded_sd * rounded_sd - lsb * lsb / 12), white_sd_dps(dwells[d], lsb));
    const auto n = static_cast<double>(dwells[d].y_dps.size());
    const double edge = (static_cast<double>(end.code) + 0.5) * lsb - end.sign * shape.median;
    beyond += n * upper_tail((edge + (holes ? 2 * lsb : 0)) / sd);
    on += n * (upper_tail((edge - lsb) / sd) - upper_tail(edge / sd));
  }
  // What keeps to the last code lies beyond it only if noise spreads other dwells over codes.
  if (wide || least_sd >= lsb) beyond += hidden;
  if (end.seen < on + 0.3 * beyond) return {};
  const double gain =
      beyond - end.seen_beyond +
      (end.seen_beyond > 0 ? end.seen_beyond * std::log(end.seen_beyond / beyond) : 0.0);
  if (end.seen_beyond > 0.2 * beyond) return {};
  return {gain, end.sign * static_cast<double>(end.code) * lsb};
}

}  // namespace gyrocal
