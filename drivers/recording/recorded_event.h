#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "compensation/values/error.h"
#include "drivers/clock.h"
#include "drivers/link.h"

namespace gyrocal {

/// One thing that passed between a program and its clock or links: all that came from outside.
struct RecordedEvent {
  enum class Kind : std::uint8_t {
    woke,        ///< sleep_until(begin) returned at `end`
    told_utc,    ///< utc_ns() said `begin`
    read,        ///< a byte link gave `received`, or an error
    written,     ///< a byte link took `sent`
    reopened,    ///< a byte link was opened
    transacted,  ///< a request link got `sent` and gave `received`
    input,       ///< asked for `sent` (a word: "stop"), the program was told `received`
  };
  Kind kind = Kind::woke;
  std::uint32_t stream = 0;  ///< which link; 0: the clock
  Instant begin{};           ///< when it was called
  Instant end{};             ///< when it returned
  /// Reads of nothing on this link since whatever happened before this: they are not events of
  /// their own, but decide where a reader paused.
  std::uint32_t empty_reads_before = 0;
  Bytes sent;
  Bytes received;
  std::optional<Error> error;
  bool operator==(const RecordedEvent&) const = default;
};

/// Packs events for compression: the small numbers of all (kinds, streams, time differences,
/// lengths as variable-length integers) first, then the bytes of all.
[[nodiscard]] Bytes encode_events(std::span<const RecordedEvent> events);
/// @return bad_frame if `bytes` are not what encode_events makes.
[[nodiscard]] Result<std::vector<RecordedEvent>> decode_events(std::span<const std::uint8_t> bytes);

}  // namespace gyrocal
