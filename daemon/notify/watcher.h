#pragma once

#include <optional>
#include <string>
#include <vector>

#include "daemon/notify/notice.h"

namespace gyrocal::notify {

/// Decides what is worth a message; each thing is told once. Pure: time comes with the views.
class Watcher {
 public:
  /// @param outage_s  a device away for so long of the machine's time.
  /// @param behind_s  the end later than promised by so much of it.
  Watcher(double outage_s, double behind_s) : outage_s_(outage_s), behind_s_(behind_s) {}

  /// Views come in order. @param machine_s  the machine's steady time.
  [[nodiscard]] std::vector<Notice> look(const status::View& view, double machine_s);

 private:
  [[nodiscard]] std::optional<Notice> ending(const status::View& view);
  [[nodiscard]] std::optional<Notice> outage(const status::View& view, double machine_s);
  [[nodiscard]] std::optional<Notice> delay(const status::View& view, double machine_s);
  [[nodiscard]] std::optional<Notice> failing(const status::View& view);
  [[nodiscard]] std::optional<Notice> silence(const status::View& view);

  double outage_s_;
  double behind_s_;
  bool ended_ = false;
  bool silent_ = false;
  std::optional<double> away_since_s_;
  bool outage_told_ = false;
  int given_up_told_ = 0;
  std::optional<double> promised_end_s_;  ///< machine time of the latest end once shown
};

}  // namespace gyrocal::notify
