#include "drivers/recording/recorded_event.h"

#include <limits>
#include <string>

namespace gyrocal {
namespace {

constexpr std::uint8_t kind_mask = 0x07;
constexpr std::uint8_t error_bit = 0x08;
constexpr auto kind_last = static_cast<std::uint8_t>(RecordedEvent::Kind::input);
constexpr auto errc_last = static_cast<std::uint64_t>(Errc::storage);

void put_number(Bytes& into, std::uint64_t value) {
  for (; value >= 0x80; value >>= 7) into.push_back(static_cast<std::uint8_t>(value | 0x80));
  into.push_back(static_cast<std::uint8_t>(value));
}

// Near zero, of either sign, is small. Differences wrap as unsigned numbers do.
void put_difference(Bytes& into, Instant from, Instant to) {
  const auto difference = static_cast<std::uint64_t>(to.time_since_epoch().count()) -
                          static_cast<std::uint64_t>(from.time_since_epoch().count());
  const bool negative = difference >> 63 != 0;
  put_number(into, negative ? ~(difference << 1) : difference << 1);
}

template <class Container>
void append(Bytes& into, const Container& from) {
  into.insert(into.end(), from.begin(), from.end());
}

/// Takes numbers and bytes from the front; remembers if there were too few.
class Reader {
 public:
  explicit Reader(std::span<const std::uint8_t> bytes) : rest_(bytes) {}

  std::uint64_t number() {
    std::uint64_t value = 0;
    for (int shift = 0; shift < 64; shift += 7) {
      if (rest_.empty()) break;
      const std::uint8_t byte = rest_.front();
      rest_ = rest_.subspan(1);
      value |= std::uint64_t{byte & 0x7FU} << shift;
      if ((byte & 0x80) == 0) return value;
    }
    failed_ = true;
    return 0;
  }
  Instant instant_after(Instant from) {
    const std::uint64_t zigzag = number();
    const std::uint64_t difference = (zigzag & 1) != 0 ? ~(zigzag >> 1) : zigzag >> 1;
    return Instant{Duration{static_cast<std::int64_t>(
        static_cast<std::uint64_t>(from.time_since_epoch().count()) + difference)}};
  }
  std::span<const std::uint8_t> bytes(std::uint64_t count) {
    if (count > rest_.size()) {
      failed_ = true;
      return {};
    }
    const auto taken = rest_.first(static_cast<std::size_t>(count));
    rest_ = rest_.subspan(taken.size());
    return taken;
  }
  [[nodiscard]] bool is_empty() const { return rest_.empty(); }
  [[nodiscard]] bool failed() const { return failed_; }

 private:
  std::span<const std::uint8_t> rest_;
  bool failed_ = false;
};

void encode(const RecordedEvent& event, Instant previous_end, Bytes& numbers, Bytes& data) {
  const int head = static_cast<int>(event.kind) | (event.error ? error_bit : 0);
  numbers.push_back(static_cast<std::uint8_t>(head));
  put_number(numbers, event.stream);
  put_difference(numbers, previous_end, event.begin);
  put_difference(numbers, event.begin, event.end);
  put_number(numbers, event.empty_reads_before);
  put_number(numbers, event.sent.size());
  put_number(numbers, event.received.size());
  append(data, event.sent);
  append(data, event.received);
  if (!event.error) return;
  put_number(numbers, static_cast<std::uint64_t>(event.error->code));
  put_number(numbers, event.error->what.size());
  put_number(numbers, event.error->advice.size());
  append(data, event.error->what);
  append(data, event.error->advice);
}

Bytes take_bytes(Reader& numbers, Reader& data) {
  const auto taken = data.bytes(numbers.number());
  return {taken.begin(), taken.end()};
}

Error take_error(Reader& numbers, Reader& data) {
  const auto code = std::min(numbers.number(), errc_last);
  const auto what = data.bytes(numbers.number());
  const auto advice = data.bytes(numbers.number());
  return {static_cast<Errc>(code), std::string(what.begin(), what.end()),
          std::string(advice.begin(), advice.end())};
}

bool decode(Reader& numbers, Reader& data, Instant previous_end, RecordedEvent& event) {
  const auto head = numbers.bytes(1);
  if (head.empty() || (head[0] & kind_mask) > kind_last || head[0] > (kind_mask | error_bit)) {
    return false;
  }
  event.kind = static_cast<RecordedEvent::Kind>(head[0] & kind_mask);
  event.stream = static_cast<std::uint32_t>(numbers.number());
  event.begin = numbers.instant_after(previous_end);
  event.end = numbers.instant_after(event.begin);
  event.empty_reads_before = static_cast<std::uint32_t>(numbers.number());
  event.sent = take_bytes(numbers, data);
  event.received = take_bytes(numbers, data);
  if ((head[0] & error_bit) != 0) event.error = take_error(numbers, data);
  return !numbers.failed() && !data.failed();
}

}  // namespace

Bytes encode_events(std::span<const RecordedEvent> events) {
  Bytes numbers;
  Bytes data;
  Instant previous_end{};
  for (const RecordedEvent& event : events) {
    encode(event, previous_end, numbers, data);
    previous_end = event.end;
  }
  Bytes all;
  put_number(all, numbers.size());
  append(all, numbers);
  append(all, data);
  return all;
}

Result<std::vector<RecordedEvent>> decode_events(std::span<const std::uint8_t> bytes) {
  Reader whole(bytes);
  Reader numbers(whole.bytes(whole.number()));
  bool good = !whole.failed();
  Reader data = whole;
  std::vector<RecordedEvent> events;
  Instant previous_end{};
  while (good && !numbers.is_empty()) {
    RecordedEvent& event = events.emplace_back();
    good = decode(numbers, data, previous_end, event);
    previous_end = event.end;
  }
  if (good && data.is_empty()) return events;
  return fail(Errc::bad_frame, "a piece of the recording does not decode",
              "the file is damaged, or of a newer version");
}

}  // namespace gyrocal
