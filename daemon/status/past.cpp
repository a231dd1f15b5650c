#include "daemon/status/past.h"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <map>

namespace gyrocal::status {
namespace {

void add(const Facts& facts, std::size_t board, const std::vector<MonitorInsert>& rows,
         std::map<std::int64_t, Point>& into) {
  for (const MonitorInsert& row : rows) {
    Point& point = into[row.t_ns];
    point.t_s = double(row.t_ns) * 1e-9;
    point.chamber_c = row.chamber_c;
    point.setpoint_c = row.setpoint_c;
    point.boards.resize(facts.boards.size());
    point.boards[board].board_c = row.board_c;
    point.boards[board].rate_z_dps =
        facts.boards[board].scale[2].to_dps(row.gyro_mean_lsb[2], row.board_c);
  }
}

}  // namespace

Result<Past> read_past(const Facts& facts, CampaignId campaign, Duration t) {
  const auto store = Store::open_read_only(facts.database);
  if (!store) return tl::unexpected(store.error());
  auto events = store->events(campaign);
  if (!events) return tl::unexpected(events.error());
  const auto boards = store->boards(campaign);
  if (!boards) return tl::unexpected(boards.error());
  std::map<std::int64_t, Point> points;
  for (std::size_t i = 0; i < std::min(boards->size(), facts.boards.size()); ++i) {
    const auto rows = store->monitor_before((*boards)[i].first, t.count());
    if (!rows) return tl::unexpected(rows.error());
    add(facts, i, *rows, points);
  }
  Past past;
  std::copy_if(std::make_move_iterator(events->begin()), std::make_move_iterator(events->end()),
               std::back_inserter(past.events),
               [&](const EventInsert& event) { return event.t_ns < t.count(); });
  for (auto& [when, point] : points) past.history.push_back(std::move(point));
  return past;
}

}  // namespace gyrocal::status
