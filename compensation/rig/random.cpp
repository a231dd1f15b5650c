#include "compensation/rig/random.h"

#include <cmath>

#include "compensation/rig/portable_math.h"

namespace gyrocal::rig {
namespace {

std::uint64_t splitmix(std::uint64_t& state) {
  std::uint64_t z = (state += 0x9E3779B97F4A7C15u);
  z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
  z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
  return z ^ (z >> 31);
}

double bell(double x) { return portable_exp(-0.5 * x * x); }

ZigguratTable make_table() {
  constexpr double tail_start = 3.6541528853610088;  // for 256 layers
  constexpr double layer_area = 0.00492867323399;
  constexpr double two_53 = 0x1p53;
  ZigguratTable table{};
  table.edge[0] = layer_area / bell(tail_start);  // the base layer, widened by its tail
  table.edge[1] = tail_start;
  for (std::size_t i = 2; i < 256; ++i) {
    const double below = table.edge[i - 1];
    table.edge[i] = std::sqrt(-2.0 * portable_log(layer_area / below + bell(below)));
  }
  table.edge[256] = 0.0;
  for (std::size_t i = 0; i <= 256; ++i) table.height[i] = bell(table.edge[i]);
  for (std::size_t i = 0; i < 256; ++i) {
    table.width[i] = table.edge[i] / two_53;
    table.inside[i] = static_cast<std::uint64_t>(table.edge[i + 1] / table.edge[i] * two_53);
  }
  return table;
}

}  // namespace

const ZigguratTable& ziggurat_table() {
  static const ZigguratTable table = make_table();
  return table;
}

RandomStream::RandomStream(const StreamKey& key) : state_{} {
  std::uint64_t mix = key.seed;
  mix = splitmix(mix) ^ (std::uint64_t{key.board} << 32 | key.axis);
  mix = splitmix(mix) ^ key.purpose;
  for (auto& word : state_) word = splitmix(mix);
}

double RandomStream::normal() {
  static const ZigguratTable& table = ziggurat_table();
  for (;;) {
    const std::uint64_t word = bits();
    const std::uint64_t layer = word & 0xFF;
    const std::uint64_t whole = word >> 11;
    const double sign = (word & 0x100) != 0 ? -1.0 : 1.0;
    const double x = static_cast<double>(whole) * table.width[layer];
    if (whole < table.inside[layer]) return sign * x;
    const double kept = normal_outside_the_layers(layer, x);
    if (kept >= 0.0) return sign * kept;
  }
}

/// The rare cases: the tail beyond the base layer, or the wedge under the curve. Negative: refused.
double RandomStream::normal_outside_the_layers(std::uint64_t layer, double x) {
  const ZigguratTable& table = ziggurat_table();
  if (layer == 0) {
    const double start = table.edge[1];
    for (;;) {
      const double beyond = -portable_log(uniform()) / start;
      const double y = -portable_log(uniform());
      if (2.0 * y > beyond * beyond) return start + beyond;
    }
  }
  const double low = table.height[layer];
  const double high = table.height[layer + 1];
  return low + uniform() * (high - low) < bell(x) ? x : -1.0;
}

double RandomStream::exponential() { return -portable_log(uniform()); }

}  // namespace gyrocal::rig
