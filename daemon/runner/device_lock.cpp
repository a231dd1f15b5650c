#include "daemon/runner/device_lock.h"

#include <fmt/core.h>
#include <sys/socket.h>
#include <sys/un.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <system_error>

namespace gyrocal::runner {
namespace {

struct Address {
  sockaddr_un raw{};
  socklen_t length = 0;
};

Address abstract_address(const std::string& name) {
  Address address;
  address.raw.sun_family = AF_UNIX;
  const std::size_t size = std::min(name.size(), sizeof address.raw.sun_path - 1);
  std::memcpy(address.raw.sun_path + 1, name.data(), size);
  address.length = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + 1 + size);
  return address;
}

int new_socket() { return ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0); }

/// "process 1234 (gyrocald)", as far as it can be found out.
std::string holder_of(const Address& address) {
  const UniqueFd asking(new_socket());
  ucred holder{};
  socklen_t length = sizeof holder;
  if (::connect(asking.get(), reinterpret_cast<const sockaddr*>(&address.raw), address.length) != 0 ||
      ::getsockopt(asking.get(), SOL_SOCKET, SO_PEERCRED, &holder, &length) != 0) {
    return "another process";
  }
  std::string name = "?";
  std::ifstream(fmt::format("/proc/{}/comm", holder.pid)) >> name;
  return fmt::format("process {} ({})", holder.pid, name);
}

}  // namespace

std::string chamber_name(const ChamberConfig& chamber) {
  const auto* tcp = std::get_if<TcpAddress>(&chamber.address);
  const std::string where = tcp ? fmt::format("{}:{}", tcp->host, tcp->port)
                                : std::get<RtuAddress>(chamber.address).device;
  return fmt::format("{} unit {}", where, chamber.unit);
}

Result<UniqueFd> lock_chamber(const ChamberConfig& chamber) {
  const std::string name = chamber_name(chamber);
  const Address address = abstract_address("gyrocal chamber " + name);
  UniqueFd lock(new_socket());
  if (::bind(lock.get(), reinterpret_cast<const sockaddr*>(&address.raw), address.length) == 0 &&
      ::listen(lock.get(), 1) == 0) {
    return lock;
  }
  const int code = errno;
  if (code != EADDRINUSE) {
    return fail(Errc::busy, fmt::format("lock chamber {}: {}", name,
                                        std::generic_category().message(code)));
  }
  return fail(Errc::busy, fmt::format("chamber {}: {} commands it already", name, holder_of(address)),
              "end that campaign first (gyrocal status, gyrocal abort)");
}

}  // namespace gyrocal::runner
