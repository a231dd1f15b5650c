#include "daemon/runner/chamber_track.h"

#include <catch2/catch.hpp>

namespace gyrocal::runner {

SCENARIO("the mean of a ramp over an interval does not depend on when it was read") {
  ChamberTrack track(seconds(15), seconds(15));
  for (const double t : {0.0, 7.0, 13.0, 20.0}) {
    track.observe(seconds(t), Celsius{20 + 0.1 * t}, Celsius{25});
  }
  CHECK(track.mean(seconds(5), seconds(10))->value == Approx(20.75));
  CHECK(track.mean(seconds(0), seconds(20))->value == Approx(21));
  CHECK(track.setpoint(seconds(10)) == Celsius{25});
}

SCENARIO("nothing is claimed beyond the readings or across a gap") {
  ChamberTrack track(seconds(15), seconds(15));
  track.observe(seconds(10), Celsius{20}, Celsius{20});
  CHECK_FALSE(track.mean(seconds(5), seconds(10)));
  track.observe(seconds(20), Celsius{20}, Celsius{20});
  CHECK(track.mean(seconds(10), seconds(20)));
  CHECK_FALSE(track.mean(seconds(15), seconds(21)));
  CHECK_FALSE(track.mean(seconds(5), seconds(15)));
  track.observe(seconds(36), Celsius{20}, Celsius{20});
  CHECK_FALSE(track.mean(seconds(22), seconds(30)));
  CHECK_FALSE(track.setpoint(seconds(9)));
}

SCENARIO("a dwell, whose air stood still before, may have a longer gap") {
  ChamberTrack track(seconds(15), seconds(60));
  for (const double t : {0.0, 10.0, 65.0, 70.0}) {
    track.observe(seconds(t), Celsius{20 + t / 100}, Celsius{20});
  }
  CHECK_FALSE(track.mean(seconds(5), seconds(68)));
  CHECK(track.dwell_mean(seconds(5), seconds(65))->value == Approx(20.35));
  CHECK(track.dwell_mean(seconds(60), seconds(80)));
  CHECK_FALSE(track.dwell_mean(seconds(60), seconds(131)));
  track.observe(seconds(131), Celsius{21}, Celsius{20});
  CHECK_FALSE(track.dwell_mean(seconds(60), seconds(131)));
}

SCENARIO("peak to peak is that of the readings inside") {
  ChamberTrack track(seconds(15), seconds(15));
  track.observe(seconds(0), Celsius{25}, Celsius{20});
  track.observe(seconds(5), Celsius{20.1}, Celsius{20});
  track.observe(seconds(10), Celsius{19.9}, Celsius{20});
  CHECK(track.peak_to_peak(seconds(5), seconds(10))->value == Approx(0.2));
  CHECK_FALSE(track.peak_to_peak(seconds(6), seconds(9)));
}

SCENARIO("what is forgotten leaves the straight line into what is kept") {
  ChamberTrack track(seconds(15), seconds(15));
  for (int t = 0; t <= 100; t += 5) track.observe(seconds(t), Celsius{20}, Celsius{20});
  track.forget_before(seconds(52));
  CHECK(track.mean(seconds(52), seconds(100)));
  CHECK_FALSE(track.mean(seconds(40), seconds(100)));
}

}  // namespace gyrocal::runner
