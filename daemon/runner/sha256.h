#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>

struct gcry_md_handle;

namespace gyrocal::runner {

/// SHA-256 (FIPS 180-4) by libgcrypt, for provenance, not for secrets.
class Sha256 {
 public:
  Sha256();
  void add(std::span<const std::uint8_t> bytes);
  /// 64 hex digits; ends the hash.
  [[nodiscard]] std::string finish();

 private:
  struct Close {
    void operator()(gcry_md_handle* handle) const;
  };
  std::unique_ptr<gcry_md_handle, Close> handle_;
};

}  // namespace gyrocal::runner
