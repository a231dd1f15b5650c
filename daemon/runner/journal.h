#pragma once

#include <functional>
#include <string>
#include <vector>

#include "drivers/clock.h"
#include "schema/store.h"

namespace gyrocal::runner {

/// Shows a person what is written into the database as an event.
using LogLine = std::function<void(const EventInsert& event)>;

/// Who stands beside the writes of a campaign; both may be empty.
struct StoreWatch {
  std::function<Result<void>()> may_store;  ///< asked before each: an error is its result instead
  std::function<void(const Error&)> not_stored;  ///< told of each that failed
};

/// A campaign's writes: events at once, the slow stream in batches. Errors are the store's.
class Journal {
 public:
  /// @param rows_per_write  of the slow stream: what a crash may cost against what a commit does.
  Journal(Store& store, CampaignId campaign, const Clock& clock, LogLine log, StoreWatch watch,
          std::size_t rows_per_write);

  [[nodiscard]] Result<void> event(Duration t, const std::string& severity, const std::string& kind,
                                   const std::string& text);
  /// The state machine is in another state: an event row and the campaign's state.
  [[nodiscard]] Result<void> transition(Duration t, const std::string& state,
                                        const std::string& text);
  [[nodiscard]] Result<void> monitor(const MonitorInsert& row);
  [[nodiscard]] Result<void> flush();
  [[nodiscard]] Result<std::vector<DwellId>> group(std::span<const DwellWithSamples> dwells);

  /// For a write that does not go through here: whether it may be done, and what came of it.
  [[nodiscard]] Result<void> may_store() const;
  template <class T>
  [[nodiscard]] Result<T> noted(Result<T> stored) const {
    if (!stored && watch_.not_stored) watch_.not_stored(stored.error());
    return stored;
  }

 private:
  Store& store_;
  CampaignId campaign_;
  const Clock& clock_;
  LogLine log_;
  StoreWatch watch_;
  std::size_t rows_per_write_;
  std::vector<MonitorInsert> pending_;
  Duration told_ = Duration::min();  ///< of the latest event
};

}  // namespace gyrocal::runner
