#pragma once

#include <cstdint>
#include <deque>
#include <optional>

#include "config/campaign.h"
#include "drivers/recording/recording_layers.h"

namespace gyrocal::runner {

/// The names of a campaign's links in its recording: "chamber", then "board left" ...
[[nodiscard]] std::vector<std::string> link_names(const CampaignConfig& config);

/// Puts the recording layers over the links of a campaign, in the order of link_names(), or leaves
/// clock and links as they are where nothing is recorded.
class LinkLayers {
 public:
  /// @param below   what the links themselves take.
  /// @param writer  nothing is recorded without one. Both outlive this.
  LinkLayers(Clock& below, RecordingWriter* writer);

  [[nodiscard]] Clock& clock();  ///< for drivers and daemon
  [[nodiscard]] RequestLink& over(RequestLink& link);
  [[nodiscard]] ByteLink& over(ByteLink& link);
  [[nodiscard]] Recorder* recorder() { return recorder_ ? &*recorder_ : nullptr; }

 private:
  Clock& below_;
  std::optional<Recorder> recorder_;
  std::optional<RecordingClock> clock_;
  std::deque<RecordingRequestLink> request_links_;  // referred to: no reallocation
  std::deque<RecordingByteLink> byte_links_;
  std::uint32_t streams_ = 0;
};

}  // namespace gyrocal::runner
