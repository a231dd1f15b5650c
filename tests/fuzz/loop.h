#pragma once

#include <algorithm>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <random>
#include <string>
#include <vector>

namespace gyrocal::fuzz {

using Bytes = std::vector<std::uint8_t>;

/// A mutation of `bytes`: bits flipped, bytes set, dropped, doubled or inserted, pieces of another
/// input spliced in, the end cut off.
inline Bytes mutated(Bytes bytes, const Bytes& other, std::mt19937_64& random) {
  const auto below = [&random](std::size_t limit) { return limit == 0 ? 0 : random() % limit; };
  for (auto changes = 1 + below(6); changes > 0; --changes) {
    const auto at = static_cast<std::ptrdiff_t>(below(bytes.size() + 1));
    const bool inside = at < static_cast<std::ptrdiff_t>(bytes.size());
    constexpr std::uint8_t telling[] = {0x00, 0x01, 0x7F, 0x80, 0xFF, 0x40, 0x41, 0x52, 0xC0};
    switch (below(7)) {
      case 0:
        if (inside)
          bytes[static_cast<std::size_t>(at)] ^= static_cast<std::uint8_t>(1u << below(8));
        break;
      case 1:
        if (inside) bytes[static_cast<std::size_t>(at)] = telling[below(std::size(telling))];
        break;
      case 2:
        if (inside) bytes.erase(bytes.begin() + at);
        break;
      case 3:
        bytes.insert(bytes.begin() + at, static_cast<std::uint8_t>(random()));
        break;
      case 4: {
        const auto from = static_cast<std::ptrdiff_t>(below(other.size()));
        const auto count = static_cast<std::ptrdiff_t>(below(16));
        const auto end = std::min(static_cast<std::ptrdiff_t>(other.size()), from + count);
        bytes.insert(bytes.begin() + at, other.begin() + from, other.begin() + end);
        break;
      }
      case 5:
        bytes.resize(static_cast<std::size_t>(at));
        break;
      default: {
        const Bytes tail(bytes.begin() + at, bytes.end());
        bytes.insert(bytes.end(), tail.begin(), tail.end());
        if (bytes.size() > 4096) bytes.resize(4096);
      }
    }
  }
  return bytes;
}

/// Feeds `count` inputs, made from the seeds by number, to `check`, which aborts on a broken
/// promise. Input number n is the same on every run and machine, so the number printed with a
/// failure is all it takes to repeat it: PROGRAM 1 n.
///
///   int main(int argc, char** argv) { return run(argc, argv, seeds(), check); }
inline int run(int argc, char** argv, const std::vector<Bytes>& seeds,
               const std::function<void(const Bytes&, std::mt19937_64&)>& check) {
  const auto count = argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 20000;
  const auto first = argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 0;
  static unsigned long long current = 0;
  std::signal(SIGABRT, [](int) { std::fprintf(stderr, "input %llu failed\n", current); });
  for (auto n = first; n < first + count; ++n) {
    current = n;
    std::mt19937_64 random(n);
    const Bytes& seed = seeds[random() % seeds.size()];
    const Bytes& other = seeds[random() % seeds.size()];
    check(mutated(seed, other, random), random);
  }
  std::printf("%llu inputs from number %llu: no promise broken\n", count, first);
  return 0;
}

}  // namespace gyrocal::fuzz
