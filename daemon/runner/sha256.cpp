#include "daemon/runner/sha256.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace gyrocal::runner {
namespace {

/// First 32 bits of the fractional parts of the cube roots of the first 64 primes (FIPS 180-4,
/// 4.2.2), by integer arithmetic: floor(cbrt(p) * 2^32) mod 2^32.
constexpr std::array<std::uint32_t, 64> round_constants() {
  std::array<std::uint32_t, 64> k{};
  std::size_t found = 0;
  for (std::uint32_t p = 2; found < k.size(); ++p) {
    bool prime = true;
    for (std::uint32_t d = 2; d * d <= p; ++d) prime = prime && p % d != 0;
    if (!prime) continue;
    // The largest r with r^3 <= p * 2^96, bit by bit; 128 bits hold it below 2^36 cubed.
    __extension__ typedef unsigned __int128 Wide;
    const Wide target = Wide{p} << 96;
    std::uint64_t root = 0;
    for (int bit = 35; bit >= 0; --bit) {
      const std::uint64_t trial = root | (std::uint64_t{1} << bit);
      if (Wide{trial} * trial * trial <= target) root = trial;
    }
    k[found++] = static_cast<std::uint32_t>(root);
  }
  return k;
}

constexpr auto k = round_constants();

}  // namespace

void Sha256::add(std::span<const std::uint8_t> bytes) {
  std::size_t fill = length_ % buffer_.size();
  length_ += bytes.size();
  while (!bytes.empty()) {
    const std::size_t taken = std::min(bytes.size(), buffer_.size() - fill);
    std::copy_n(bytes.begin(), taken, buffer_.begin() + static_cast<std::ptrdiff_t>(fill));
    bytes = bytes.subspan(taken);
    fill += taken;
    if (fill == buffer_.size()) {
      block(buffer_.data());
      fill = 0;
    }
  }
}

void Sha256::block(const std::uint8_t* data) {
  std::array<std::uint32_t, 64> w{};
  for (std::size_t i = 0; i < 16; ++i) {
    w[i] = std::uint32_t{data[4 * i]} << 24 | std::uint32_t{data[4 * i + 1]} << 16 |
           std::uint32_t{data[4 * i + 2]} << 8 | std::uint32_t{data[4 * i + 3]};
  }
  for (std::size_t i = 16; i < 64; ++i) {
    const std::uint32_t s0 = std::rotr(w[i - 15], 7) ^ std::rotr(w[i - 15], 18) ^ (w[i - 15] >> 3);
    const std::uint32_t s1 = std::rotr(w[i - 2], 17) ^ std::rotr(w[i - 2], 19) ^ (w[i - 2] >> 10);
    w[i] = w[i - 16] + s0 + w[i - 7] + s1;
  }
  auto [a, b, c, d, e, f, g, h] = state_;
  for (std::size_t i = 0; i < 64; ++i) {
    const std::uint32_t s1 = std::rotr(e, 6) ^ std::rotr(e, 11) ^ std::rotr(e, 25);
    const std::uint32_t t1 = h + s1 + ((e & f) ^ (~e & g)) + k[i] + w[i];
    const std::uint32_t s0 = std::rotr(a, 2) ^ std::rotr(a, 13) ^ std::rotr(a, 22);
    const std::uint32_t t2 = s0 + ((a & b) ^ (a & c) ^ (b & c));
    h = g;
    g = f;
    f = e;
    e = d + t1;
    d = c;
    c = b;
    b = a;
    a = t1 + t2;
  }
  const std::array<std::uint32_t, 8> step{a, b, c, d, e, f, g, h};
  for (std::size_t i = 0; i < 8; ++i) state_[i] += step[i];
}

std::string Sha256::finish() {
  const std::uint64_t bits = length_ * 8;
  const std::array<std::uint8_t, 1> one{0x80};
  add(one);
  const std::array<std::uint8_t, 1> zero{0};
  while (length_ % 64 != 56) add(zero);
  std::array<std::uint8_t, 8> tail{};
  for (std::size_t i = 0; i < 8; ++i) tail[i] = static_cast<std::uint8_t>(bits >> (56 - 8 * i));
  add(tail);
  std::string hex;
  for (const std::uint32_t word : state_) {
    for (int shift = 28; shift >= 0; shift -= 4) hex += "0123456789abcdef"[(word >> shift) & 15];
  }
  return hex;
}

}  // namespace gyrocal::runner
