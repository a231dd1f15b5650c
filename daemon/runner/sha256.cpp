#include "daemon/runner/sha256.h"

#include <fmt/format.h>
#include <gcrypt.h>

#include "compensation/values/assert.h"

namespace gyrocal::runner {
namespace {

constexpr std::size_t digest_bytes = 32;

gcry_md_hd_t open_handle() {
  // The library wants its version asked for before anything else.
  static const char* const version = gcry_check_version(nullptr);
  gcry_md_hd_t handle = nullptr;
  const gcry_error_t error = gcry_md_open(&handle, GCRY_MD_SHA256, 0);
  GYROCAL_ASSERT(version != nullptr && error == 0);
  return handle;
}

}  // namespace

Sha256::Sha256() : handle_(open_handle()) {}

void Sha256::Close::operator()(gcry_md_handle* handle) const { gcry_md_close(handle); }

void Sha256::add(std::span<const std::uint8_t> bytes) {
  gcry_md_write(handle_.get(), bytes.data(), bytes.size());
}

std::string Sha256::finish() {
  const unsigned char* const digest = gcry_md_read(handle_.get(), GCRY_MD_SHA256);
  std::string hex;
  for (std::size_t i = 0; i < digest_bytes; ++i) hex += fmt::format("{:02x}", digest[i]);
  return hex;
}

}  // namespace gyrocal::runner
