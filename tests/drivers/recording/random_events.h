#pragma once

#include <random>
#include <vector>

#include "drivers/recording/recorded_event.h"

namespace gyrocal::test {

inline RecordedEvent random_event(std::mt19937& random) {
  const auto below = [&random](unsigned limit) { return static_cast<unsigned>(random() % limit); };
  const auto bytes = [&] {
    Bytes some(below(40));
    for (auto& byte : some) byte = static_cast<std::uint8_t>(random());
    return some;
  };
  RecordedEvent event;
  event.kind = static_cast<RecordedEvent::Kind>(below(7));
  event.stream = below(4);
  event.begin = Instant{Duration{static_cast<std::int64_t>(random()) * 1'000'003}};
  event.end = event.begin + Duration{static_cast<std::int64_t>(random()) - 1'000'000};
  event.empty_reads_before = below(3);
  event.sent = bytes();
  event.received = bytes();
  if (below(4) == 0) event.error = Error{static_cast<Errc>(below(12)), "what", "advice"};
  return event;
}

inline std::vector<RecordedEvent> random_events(std::size_t count, std::mt19937& random) {
  std::vector<RecordedEvent> events;
  while (events.size() < count) events.push_back(random_event(random));
  return events;
}

}  // namespace gyrocal::test
