#include "drivers/recording/compression.h"

#include <fmt/format.h>
#include <zstd.h>

#include <memory>

#include "compensation/values/assert.h"

namespace gyrocal {
namespace {

struct FreeContext {
  void operator()(ZSTD_CCtx* context) const noexcept { ZSTD_freeCCtx(context); }
};

}  // namespace

Bytes compressed(std::span<const std::uint8_t> bytes, int level) {
  const std::unique_ptr<ZSTD_CCtx, FreeContext> context{ZSTD_createCCtx()};
  GYROCAL_ASSERT(context != nullptr);
  ZSTD_CCtx_setParameter(context.get(), ZSTD_c_compressionLevel, level);
  ZSTD_CCtx_setParameter(context.get(), ZSTD_c_checksumFlag, 1);
  Bytes packed(ZSTD_compressBound(bytes.size()));
  const std::size_t size =
      ZSTD_compress2(context.get(), packed.data(), packed.size(), bytes.data(), bytes.size());
  GYROCAL_ASSERT(ZSTD_isError(size) == 0);  // the room is what the library asked for
  packed.resize(size);
  return packed;
}

Result<Bytes> decompressed(std::span<const std::uint8_t> bytes, std::size_t bytes_max) {
  const auto size = ZSTD_getFrameContentSize(bytes.data(), bytes.size());
  const bool known = size != ZSTD_CONTENTSIZE_UNKNOWN && size != ZSTD_CONTENTSIZE_ERROR;
  if (!known || size > bytes_max) {
    return fail(Errc::bad_frame, "a piece of the recording is no zstd frame of sensible size",
                "the file is damaged");
  }
  Bytes unpacked(static_cast<std::size_t>(size));
  const std::size_t got =
      ZSTD_decompress(unpacked.data(), unpacked.size(), bytes.data(), bytes.size());
  if (ZSTD_isError(got) == 0 && got == unpacked.size()) return unpacked;
  return fail(Errc::bad_frame,
              fmt::format("a piece of the recording does not unpack: {}", ZSTD_getErrorName(got)),
              "the file is damaged");
}

}  // namespace gyrocal
