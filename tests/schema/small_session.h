#pragma once

#include "compensation/values/records.h"

/// Two dwells of twelve samples at 10 Hz in a record of 60 s, everything measured.
inline gyrocal::Session small_session() {
  gyrocal::Session session;
  session.device = "bench";
  session.axis = 'y';
  session.sample_rate_hz = 10;
  session.monitor_interval_s = 5;
  session.lsb_dps = 0.25;
  session.samples_per_dwell = 12;
  session.dwells = {{0, -10, 20}, {1, 20, 40}};
  for (int i = 0; i < 12; ++i) {
    session.monitor.push_back({2.5 + 5 * i, 20, 19.75, 21.5, 4.0 + 0.01 * i});
  }
  for (const auto& dwell : session.dwells) {
    for (int seq = 0; seq < 12; ++seq) {
      session.samples.push_back({dwell.dwell,
                                 seq,
                                 dwell.t_start_s + 0.1 * seq,
                                 4.0 + 0.25 * seq,
                                 {0.01, -0.02, 1.0},
                                 21.5,
                                 19.75});
    }
  }
  return session;
}
