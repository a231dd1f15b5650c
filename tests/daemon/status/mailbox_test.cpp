#include "daemon/status/mailbox.h"

#include <atomic>
#include <catch2/catch.hpp>
#include <thread>

#include "tests/daemon/status/sample_view.h"

namespace gyrocal::status {

SCENARIO("the newest snapshot and every event arrive, in order, from another thread") {
  Mailbox mailbox;
  constexpr int turns = 20000;
  std::atomic<bool> done = false;
  std::thread loop([&] {
    for (int i = 1; i <= turns; ++i) {
      runner::Snapshot now;
      now.t = Duration{i};
      mailbox.put(now);
      if (i % 10 == 0) mailbox.put(EventInsert{i, 0, "info", "tick", ""});
    }
    done = true;
  });
  Duration newest{};
  std::int64_t last = 0;
  int events = 0;
  const auto take = [&] {
    const auto content = mailbox.take();
    if (content.snapshot) {
      CHECK(content.snapshot->t > newest);
      newest = content.snapshot->t;
    }
    for (const EventInsert& event : content.events) {
      CHECK(event.t_ns == last + 10);
      last = event.t_ns;
      ++events;
    }
  };
  while (!done) take();
  loop.join();
  runner::Snapshot end;  // what the loop could not hand over goes with its next turn
  end.t = Duration{turns + 1};
  mailbox.put(end);
  take();
  CHECK(newest == Duration{turns + 1});
  CHECK(events == turns / 10);
}

SCENARIO("a watcher that never looks costs a bounded amount of memory") {
  Mailbox mailbox;
  for (std::size_t i = 0; i < 3 * Mailbox::events_max; ++i) {
    mailbox.put(EventInsert{static_cast<std::int64_t>(i), 0, "info", "tick", ""});
  }
  const auto content = mailbox.take();
  REQUIRE(content.events.size() == Mailbox::events_max);
  CHECK(content.events.back().t_ns == 3 * Mailbox::events_max - 1);
}

}  // namespace gyrocal::status
