#include "drivers/simulated/modbus_tcp_server.h"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>

#include <array>
#include <cerrno>
#include <cstring>

#include "drivers/big_endian.h"

namespace gyrocal {
namespace {

constexpr std::size_t clients_max = 16;
constexpr auto half_request_time = std::chrono::seconds(1);
constexpr std::size_t header_bytes = 6;  // transaction, protocol, length; the unit id follows
constexpr std::size_t length_max = 254;  // unit id and a PDU of 253
constexpr std::size_t chunk_bytes = 1024;

/// Length field of a complete header; nothing if these bytes are no Modbus TCP.
std::optional<std::size_t> length_in(std::span<const std::uint8_t> header) {
  const std::size_t length = get_u16(header, 4);
  if (get_u16(header, 2) != 0 || length < 2 || length > length_max) return {};
  return length;
}

}  // namespace

ModbusTcpServer::ModbusTcpServer(UniqueFd listener, std::string host, int port)
    : listener_(std::move(listener)), host_(std::move(host)), port_(port) {}

Result<ModbusTcpServer> ModbusTcpServer::open(const std::string& host, int port) {
  auto listener = listen_at(host, port);
  if (!listener) return tl::unexpected(listener.error());
  sockaddr_in bound{};
  socklen_t size = sizeof bound;
  if (::getsockname(listener->get(), reinterpret_cast<sockaddr*>(&bound), &size) != 0) {
    return fail(Errc::link_lost, fmt::format("getsockname: {}", std::strerror(errno)));
  }
  return ModbusTcpServer(*std::move(listener), host, ntohs(bound.sin_port));
}

Result<UniqueFd> ModbusTcpServer::listen_at(const std::string& host, int port) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  if (::inet_pton(AF_INET, host.c_str(), &address.sin_addr) != 1) {
    return fail(Errc::bad_input, fmt::format("listen on \"{}\": no IPv4 address", host),
                "give a numeric address, 127.0.0.1");
  }
  UniqueFd listener(::socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
  const int on = 1;
  if (!listener.is_open() ||
      ::setsockopt(listener.get(), SOL_SOCKET, SO_REUSEADDR, &on, sizeof on) != 0 ||
      ::bind(listener.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0 ||
      ::listen(listener.get(), static_cast<int>(clients_max)) != 0) {
    const int code = errno;
    return fail(code == EADDRINUSE ? Errc::busy : Errc::link_lost,
                fmt::format("listen on {}:{}: {}", host, port, std::strerror(code)),
                code == EADDRINUSE ? "another rig? port 0 takes a free one"
                                   : "is this an address of this machine, a port above 1023?");
  }
  return listener;
}

void ModbusTcpServer::set_refusing(bool refusing) {
  if (refusing == refusing_) return;
  if (refusing) {
    clients_.clear();
    listener_ = UniqueFd{};  // a listener nobody accepts from would still complete the handshake
  } else if (auto again = listen_at(host_, port_)) {
    listener_ = *std::move(again);
  } else {
    return;  // tried again at the next call
  }
  refusing_ = refusing;
}

void ModbusTcpServer::watch(std::vector<pollfd>& into) const {
  if (listener_.is_open()) into.push_back({listener_.get(), POLLIN, 0});
  for (const Client& client : clients_) into.push_back({client.fd.get(), POLLIN, 0});
}

std::optional<ModbusTcpServer::WallTime> ModbusTcpServer::deadline() const {
  std::optional<WallTime> first;
  const auto consider = [&](WallTime time) {
    if (!first || time < *first) first = time;
  };
  for (const Client& client : clients_) {
    if (!client.received.empty()) consider(client.last_byte + half_request_time);
    for (const LateReply& late : client.late) consider(late.due);
  }
  return first;
}

void ModbusTcpServer::serve(WallTime now, const Handler& handler) {
  if (listener_.is_open()) accept_clients();
  for (auto client = clients_.begin(); client != clients_.end();) {
    const bool stays =
        receive(*client, now) && answer_all(*client, now, handler) && send_late(*client, now);
    client = stays ? std::next(client) : clients_.erase(client);
  }
}

void ModbusTcpServer::accept_clients() {
  for (;;) {
    UniqueFd fd(::accept4(listener_.get(), nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC));
    if (!fd.is_open()) return;
    if (clients_.size() == clients_max) continue;  // closed: the controller takes no more
    const int on = 1;
    ::setsockopt(fd.get(), IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
    clients_.push_back({std::move(fd), {}, {}, {}});
  }
}

bool ModbusTcpServer::receive(Client& client, WallTime now) {
  std::array<std::uint8_t, chunk_bytes> chunk;
  const ssize_t count = ::recv(client.fd.get(), chunk.data(), chunk.size(), 0);
  if (count == 0) return false;
  if (count < 0) {
    if (errno != EAGAIN && errno != EINTR) return false;
    return client.received.empty() || now < client.last_byte + half_request_time;
  }
  client.received.insert(client.received.end(), chunk.begin(), chunk.begin() + count);
  client.last_byte = now;
  return true;
}

bool ModbusTcpServer::answer_all(Client& client, WallTime now, const Handler& handler) {
  std::size_t done = 0;
  const std::span<const std::uint8_t> all(client.received);
  while (all.size() - done >= header_bytes) {
    const auto header = all.subspan(done, header_bytes);
    const auto length = length_in(header);
    if (!length) return false;
    if (all.size() - done < header_bytes + *length) break;
    const auto answer = handler(all.subspan(done + header_bytes, *length));
    if (!give(client, header, answer, now)) return false;
    done += header_bytes + *length;
  }
  client.received.erase(client.received.begin(),
                        client.received.begin() + static_cast<std::ptrdiff_t>(done));
  return true;
}

bool ModbusTcpServer::give(Client& client, std::span<const std::uint8_t> header,
                           const ChamberAnswer& answer, WallTime now) {
  using Way = ChamberAnswer::Way;
  if (answer.way == Way::hang_up) return false;
  if (answer.way == Way::silence) return true;
  Bytes frame(header.begin(), header.begin() + 4);
  put_u16(frame, static_cast<std::uint16_t>(answer.reply.size()));
  frame.insert(frame.end(), answer.reply.begin(), answer.reply.end());
  if (answer.way == Way::half) frame.resize(frame.size() / 2);
  if (answer.way == Way::twice) {
    const Bytes once = frame;
    frame.insert(frame.end(), once.begin(), once.end());
  }
  if (answer.delay == Duration::zero()) return send(client, frame);
  client.late.push_back({now + answer.delay, std::move(frame)});
  return true;
}

bool ModbusTcpServer::send_late(Client& client, WallTime now) {
  for (auto late = client.late.begin(); late != client.late.end();) {
    if (late->due > now) {
      ++late;
      continue;
    }
    if (!send(client, late->bytes)) return false;
    late = client.late.erase(late);
  }
  return true;
}

bool ModbusTcpServer::send(const Client& client, std::span<const std::uint8_t> bytes) {
  const ssize_t sent = ::send(client.fd.get(), bytes.data(), bytes.size(), MSG_NOSIGNAL);
  return sent == static_cast<ssize_t>(bytes.size());  // a client that reads nothing goes
}

}  // namespace gyrocal
