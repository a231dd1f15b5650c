#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace gyrocal::runner {

/// SHA-256 (FIPS 180-4), for provenance, not for secrets.
class Sha256 {
 public:
  void add(std::span<const std::uint8_t> bytes);
  /// 64 hex digits; ends the hash.
  [[nodiscard]] std::string finish();

 private:
  void block(const std::uint8_t* data);

  std::array<std::uint32_t, 8> state_{0x6a09e667, 0xbb67ae85, 0x3c6ef372, 0xa54ff53a,
                                      0x510e527f, 0x9b05688c, 0x1f83d9ab, 0x5be0cd19};
  std::array<std::uint8_t, 64> buffer_{};
  std::uint64_t length_ = 0;
};

}  // namespace gyrocal::runner
