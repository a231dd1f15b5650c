#include "daemon/runner/link_layers.h"

namespace gyrocal::runner {

std::vector<std::string> link_names(const CampaignConfig& config) {
  std::vector<std::string> names{"chamber"};
  for (const auto& board : config.boards) names.push_back("board " + board.name);
  return names;
}

LinkLayers::LinkLayers(Clock& below, RecordingWriter* writer) : below_(below) {
  if (writer == nullptr) return;
  recorder_.emplace(below, *writer);
  clock_.emplace(*recorder_);
}

Clock& LinkLayers::clock() { return clock_ ? static_cast<Clock&>(*clock_) : below_; }

RequestLink& LinkLayers::over(RequestLink& link) {
  return recorder_ ? request_links_.emplace_back(link, *recorder_, ++streams_) : link;
}

ByteLink& LinkLayers::over(ByteLink& link) {
  return recorder_ ? byte_links_.emplace_back(link, *recorder_, ++streams_) : link;
}

}  // namespace gyrocal::runner
