#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>

#include "compensation/values/error.h"
#include "drivers/clock.h"

namespace gyrocal::replay {

struct CapsuleRequest {
  std::string database;
  std::string recording{};                 ///< empty: beside the database
  std::optional<std::int64_t> campaign{};  ///< default: the latest
  Duration from = Duration::min();         ///< campaign time
  Duration to = Duration::max();
  std::string out;
  std::string software_version;
};

struct Capsule {
  std::int64_t runs = 0;
  Duration from{};  ///< where the first of its runs begins
  Duration to{};    ///< where the last of its bytes is
  std::uintmax_t bytes = 0;
  std::string note;  ///< what it says of itself
};

/// Cuts one file out of a campaign, for a bug report: the bytes of its links, the campaign's
/// database, the campaign file and the chamber's profile. It replays where neither is.
///
/// A run is replayed from its beginning, where its state is known, so a window takes along the
/// bytes from the beginning of the run that `from` lies in; what earlier runs stored is in the
/// database. Bytes and rows later than `to` are left out, and models with them.
/// @return busy: `out` exists; bad_input: nothing was recorded in that window; what reading and
///   writing return.
[[nodiscard]] Result<Capsule> cut_capsule(const CapsuleRequest& request);

}  // namespace gyrocal::replay
