#include "compensation/discrepancy/gap_shadow.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "compensation/discrepancy/diagnosis.h"
#include "compensation/discrepancy/segments.h"
#include "compensation/rig/simulate_session.h"
#include "tests/compensation/quiet_rig.h"

using namespace gyrocal;

namespace {

/// The rows from `begin_s` to `end_s` are lost.
Session with_gap(Session session, double begin_s, double end_s) {
  std::erase_if(session.monitor,
                [&](const MonitorRow& row) { return row.t_s > begin_s && row.t_s < end_s; });
  return session;
}

std::vector<std::size_t> shadow_of(const Session& session) {
  return rows_in_gap_shadow(session, make_track(session, split_segments(session), {}));
}

/// The end of a dwell: what follows is a ramp.
double ramp_begins_s(const Session& session, std::size_t dwell) {
  return session.dwells[dwell].t_start_s + 60;
}

}  // namespace

TEST_CASE("a record without gaps casts no shadow, a gap in a soak a short one") {
  const Session session = rig::simulate_session(quiet_rig(), {}, 1);
  CHECK(shadow_of(session).empty());
  const double soaked_s = session.dwells[4].t_start_s - 300;
  const Session gappy = with_gap(session, soaked_s, soaked_s + 250);
  const auto rows = shadow_of(gappy);  // the air cycles by some tenths of a degree
  const bool over_soon = rows.empty() || gappy.monitor[rows.back()].t_s < soaked_s + 250 + 1000;
  CHECK(over_soon);
}

TEST_CASE("after a gap over a ramp rows are in its shadow until the lags have forgotten it") {
  const Session whole = rig::simulate_session(quiet_rig(), {}, 1);
  const double begin_s = ramp_begins_s(whole, 4), end_s = begin_s + 600;
  const Session session = with_gap(whole, begin_s, end_s);
  const auto rows = shadow_of(session);
  REQUIRE_FALSE(rows.empty());
  CHECK(session.monitor[rows.front()].t_s >= end_s);
  const double lasts_s = session.monitor[rows.back()].t_s - end_s;
  CHECK(lasts_s > 300);
  CHECK(lasts_s < 3600);
  CHECK(rows.back() - rows.front() + 1 == rows.size());
}

TEST_CASE("a missing chamber column for a while is a gap too") {
  Session session = rig::simulate_session(quiet_rig(), {}, 1);
  const double begin_s = ramp_begins_s(session, 4), end_s = begin_s + 600;
  for (MonitorRow& row : session.monitor) {
    if (row.t_s > begin_s && row.t_s < end_s) row.chamber_c = std::nan("");
  }
  const auto rows = shadow_of(session);
  REQUIRE_FALSE(rows.empty());
  CHECK(session.monitor[rows.front()].t_s < end_s);
}

TEST_CASE("gaps over ramps make no drift", "[diagnose]") {
  const auto dwell = GENERATE(as<std::size_t>{}, 3, 8, 15, 20);
  const Session whole = rig::simulate_session(quiet_rig(), {}, 1);
  const double begin_s = ramp_begins_s(whole, dwell) + 60;
  const auto found = diagnose(with_gap(whole, begin_s, begin_s + 500), {}, {});
  REQUIRE(found.has_value());
  CHECK(found->verdict == Verdict::consistent);
}
