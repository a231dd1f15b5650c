#include "compensation/discrepancy/segments.h"

#include <algorithm>
#include <limits>

namespace gyrocal {
namespace {

constexpr std::size_t hold_out_every = 5;
constexpr std::size_t first_held_out = 2;
constexpr std::size_t segments_min = 4;

}  // namespace

std::vector<Segment> split_segments(const Session& session) {
  const double dwell_s = session.samples_per_dwell / session.sample_rate_hz;
  std::vector<Segment> segments;
  double begin_s = -std::numeric_limits<double>::infinity();
  for (const SessionDwell& dwell : session.dwells) {
    Segment segment;
    segment.dwell = dwell.dwell;
    segment.begin_s = begin_s;
    segment.dwell_begin_s = dwell.t_start_s;
    segment.dwell_end_s = dwell.t_start_s + dwell_s;
    segment.end_s = segment.dwell_end_s;
    begin_s = segment.end_s;
    segments.push_back(segment);
  }
  segments.back().end_s = std::numeric_limits<double>::infinity();
  if (segments.size() < segments_min) return segments;
  for (std::size_t i = first_held_out; i + 1 < segments.size(); i += hold_out_every) {
    segments[i].held_out = true;
  }
  return segments;
}

bool is_held_out(std::span<const Segment> segments, double t_s) {
  return std::any_of(segments.begin(), segments.end(), [t_s](const Segment& segment) {
    return segment.held_out && t_s > segment.begin_s && t_s <= segment.end_s;
  });
}

bool may_train_on(std::span<const Segment> segments, double t_s) {
  return std::none_of(segments.begin(), segments.end(), [t_s](const Segment& segment) {
    return segment.held_out && t_s > segment.begin_s - guard_s && t_s <= segment.end_s + guard_s;
  });
}

}  // namespace gyrocal
