#include "daemon/campaign/pace.h"

#include <algorithm>

namespace gyrocal::campaign {
namespace {

constexpr std::size_t visits_min = 2;

Duration median(std::vector<Duration> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

Duration Pace::late_by(Duration t, Duration planned) const {
  return (t - visiting_->since - still_) - (visiting_->planned - planned);
}

void Pace::heading_for(std::size_t point, Duration t, Duration planned) {
  if (visiting_ && visiting_->point == point) return;
  if (visiting_) late_.push_back(late_by(t, planned));
  visiting_ = Visiting{point, t, planned};
  still_ = {};
}

Duration Pace::left(Duration t, Duration planned, std::size_t after) const {
  if (!visiting_ || late_.size() < visits_min) return planned;
  const Duration usual = median(late_);
  const Duration still_to_come =
      std::max(usual - std::max(late_by(t, planned), Duration{}), Duration{});
  return std::max(planned + still_to_come + static_cast<int>(after) * usual, Duration{});
}

}  // namespace gyrocal::campaign
