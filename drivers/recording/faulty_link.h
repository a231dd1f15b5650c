#pragma once

#include <cstddef>
#include <span>

#include "drivers/link.h"

namespace gyrocal {

/// Which call of a link fails, counted from 0, and how: so that a test can let the first fail, then
/// the second, until every call had its turn.
struct Fault {
  enum class Lasts { once, for_good };
  /// Whether the device hears of the failing call: a lost request, or a lost reply.
  enum class Loses { request, reply };
  std::size_t call = 0;
  Errc code = Errc::timeout;
  Lasts lasts = Lasts::once;
  Loses loses = Loses::request;
};

/// Counts the calls of a link and says which are to fail.
class FaultSchedule {
 public:
  explicit FaultSchedule(Fault fault) : fault_(fault) {}
  [[nodiscard]] bool next_call_fails();
  [[nodiscard]] bool fired() const { return calls_ > fault_.call; }
  [[nodiscard]] bool loses_reply() const { return fault_.loses == Fault::Loses::reply; }
  [[nodiscard]] tl::unexpected<Error> error() const;

 private:
  Fault fault_;
  std::size_t calls_ = 0;
};

class FaultyRequestLink final : public RequestLink {
 public:
  FaultyRequestLink(RequestLink& target, Fault fault) : target_(target), schedule_(fault) {}
  [[nodiscard]] Result<Bytes> transact(std::span<const std::uint8_t> request) override;
  [[nodiscard]] bool fired() const { return schedule_.fired(); }  ///< the call took place

 private:
  RequestLink& target_;
  FaultSchedule schedule_;
};

/// Reads, writes and reopenings count as calls alike.
class FaultyByteLink final : public ByteLink {
 public:
  FaultyByteLink(ByteLink& target, Fault fault) : target_(target), schedule_(fault) {}
  [[nodiscard]] Result<std::size_t> read(std::span<std::uint8_t> into) override;
  [[nodiscard]] Result<void> write(std::span<const std::uint8_t> bytes) override;
  [[nodiscard]] Result<void> reopen() override;
  [[nodiscard]] bool fired() const { return schedule_.fired(); }

 private:
  ByteLink& target_;
  FaultSchedule schedule_;
};

}  // namespace gyrocal
