#include "config/setpoints.h"

#include <algorithm>
#include <utility>

namespace gyrocal {
namespace {

struct SplitMix64 {
  std::uint64_t state;
  std::uint64_t next() {
    std::uint64_t z = (state += 0x9E3779B97F4A7C15U);
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9U;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBU;
    return z ^ (z >> 31);
  }
};

void shuffle(std::vector<Celsius>& points, std::uint64_t seed) {
  SplitMix64 random{seed};
  for (std::size_t left = points.size(); left > 1; --left) {
    // The modulo's bias is below 1e-15 for any plan a chamber could finish.
    std::swap(points[left - 1], points[random.next() % left]);
  }
}

}  // namespace

std::vector<Celsius> paper_setpoints() {
  std::vector<Celsius> points;
  for (const double c : {-10, -7, -5, -2, 0,  3,  5,  8,  10, 13, 15, 18, 20,
                         23,  25, 28, 30, 33, 35, 38, 40, 43, 45, 48, 50}) {
    points.push_back({c});
  }
  return points;
}

std::vector<Celsius> in_visiting_order(std::vector<Celsius> listed, Sweep sweep,
                                       std::uint64_t seed) {
  if (sweep == Sweep::as_listed) return listed;
  std::sort(listed.begin(), listed.end());  // so that the seed alone decides a shuffled order
  if (sweep == Sweep::shuffled) shuffle(listed, seed);
  if (sweep == Sweep::up_down && listed.size() > 1) {
    const std::vector<Celsius> down(listed.rbegin() + 1, listed.rend());
    listed.insert(listed.end(), down.begin(), down.end());
  }
  return listed;
}

}  // namespace gyrocal
