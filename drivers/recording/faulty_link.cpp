#include "drivers/recording/faulty_link.h"

#include <fmt/format.h>

namespace gyrocal {
namespace {

template <class Call>
auto call_or_fail(FaultSchedule& schedule, const Call& call) -> decltype(call()) {
  if (!schedule.next_call_fails()) return call();
  if (schedule.loses_reply()) {
    if (auto unheard = call(); !unheard) return unheard;
  }
  return schedule.error();
}

}  // namespace

bool FaultSchedule::next_call_fails() {
  const std::size_t call = calls_++;
  return fault_.lasts == Fault::Lasts::once ? call == fault_.call : call >= fault_.call;
}

tl::unexpected<Error> FaultSchedule::error() const {
  return fail(fault_.code, fmt::format("injected fault at call {}", calls_ - 1));
}

Result<Bytes> FaultyRequestLink::transact(std::span<const std::uint8_t> request) {
  return call_or_fail(schedule_, [&] { return target_.transact(request); });
}

Result<std::size_t> FaultyByteLink::read(std::span<std::uint8_t> into) {
  return call_or_fail(schedule_, [&] { return target_.read(into); });
}

Result<void> FaultyByteLink::write(std::span<const std::uint8_t> bytes) {
  return call_or_fail(schedule_, [&] { return target_.write(bytes); });
}

Result<void> FaultyByteLink::reopen() {
  return call_or_fail(schedule_, [&] { return target_.reopen(); });
}

}  // namespace gyrocal
