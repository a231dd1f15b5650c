#include "daemon/notify/outbox.h"

#include <catch2/catch.hpp>

namespace gyrocal::notify {

SCENARIO("so many messages an hour, the others are counted; a trip always goes out") {
  Outbox outbox(3, 4);
  for (int i = 0; i < 3; ++i) CHECK(outbox.admits("outage", i));
  CHECK_FALSE(outbox.admits("outage", 10));
  CHECK_FALSE(outbox.admits("outage_over", 3599));
  CHECK(outbox.admits("trip", 20));
  CHECK(outbox.take_withheld() == 2);
  CHECK(outbox.take_withheld() == 0);
  CHECK(outbox.admits("outage", 7200));
}

SCENARIO("a message that fails is tried again after 10, 40 and 160 s, then given up") {
  Outbox outbox(100, 4);
  outbox.add({"subject", "outage", "{}"});
  REQUIRE(outbox.due(0));
  CHECK(outbox.failed(0));
  CHECK_FALSE(outbox.due(9));
  REQUIRE(outbox.due(10));
  CHECK(outbox.failed(10));
  CHECK_FALSE(outbox.due(49));
  REQUIRE(outbox.due(50));
  CHECK(outbox.failed(50));
  CHECK_FALSE(outbox.due(209));
  REQUIRE(outbox.due(210));
  CHECK_FALSE(outbox.failed(210));
  CHECK(outbox.empty());
}

SCENARIO("messages leave in their order") {
  Outbox outbox(100, 4);
  outbox.add({"first", "outage", "{}"});
  outbox.add({"second", "outage", "{}"});
  CHECK(outbox.failed(0));
  CHECK_FALSE(outbox.due(5));  // the second waits for the first
  CHECK(outbox.due(10)->subject == "first");
  outbox.delivered();
  CHECK(outbox.due(10)->subject == "second");
}

}  // namespace gyrocal::notify
