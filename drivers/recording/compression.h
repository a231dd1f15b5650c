#pragma once

#include <span>

#include "compensation/values/error.h"
#include "drivers/link.h"

namespace gyrocal {

/// One zstd frame with a checksum.
[[nodiscard]] Bytes compressed(std::span<const std::uint8_t> bytes, int level);
/// @return bad_frame if it is none, is damaged, or grows beyond `bytes_max`.
[[nodiscard]] Result<Bytes> decompressed(std::span<const std::uint8_t> bytes,
                                         std::size_t bytes_max);

}  // namespace gyrocal
