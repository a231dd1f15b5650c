#include "daemon/runner/journal.h"

#include <algorithm>
#include <utility>

namespace gyrocal::runner {

Journal::Journal(Store& store, CampaignId campaign, const Clock& clock, LogLine log,
                 StoreWatch watch, std::size_t rows_per_write)
    : store_(store),
      campaign_(campaign),
      clock_(clock),
      log_(std::move(log)),
      watch_(std::move(watch)),
      rows_per_write_(rows_per_write) {}

Result<void> Journal::may_store() const {
  return watch_.may_store ? watch_.may_store() : Result<void>{};
}

Result<void> Journal::event(Duration t, const std::string& severity, const std::string& kind,
                            const std::string& text) {
  // Told after what was told before it: a reading that was long on its way began earlier.
  told_ = std::max(told_, t);
  const EventInsert row{told_.count(), clock_.utc_ns(), severity, kind, text};
  if (log_) log_(row);
  if (auto may = may_store(); !may) return may;
  return noted(store_.add_event(campaign_, row));
}

Result<void> Journal::transition(Duration t, const std::string& state, const std::string& text) {
  // The state first: a trip is latched although the daemon dies before its event is written.
  if (auto may = may_store(); !may) return may;
  if (auto stored = noted(store_.set_campaign_state(campaign_, state)); !stored) return stored;
  return event(t, "info", "transition", text);
}

Result<void> Journal::monitor(const MonitorInsert& row) {
  pending_.push_back(row);
  return pending_.size() < rows_per_write_ ? Result<void>{} : flush();
}

Result<void> Journal::flush() {
  if (pending_.empty()) return {};
  if (auto may = may_store(); !may) return may;
  auto stored = noted(store_.add_monitor(campaign_, pending_));
  if (stored) pending_.clear();
  return stored;
}

Result<std::vector<DwellId>> Journal::group(std::span<const DwellWithSamples> dwells) {
  if (auto may = may_store(); !may) return tl::unexpected(may.error());
  return noted(store_.add_group(campaign_, dwells));
}

}  // namespace gyrocal::runner
