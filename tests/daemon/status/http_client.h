#pragma once

#include <arpa/inet.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <chrono>
#include <string>
#include <utility>

#include "drivers/tty_lock.h"

namespace gyrocal::status {

inline sockaddr_in local(int port) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  return address;
}

/// A port nobody listens on.
inline int free_port() {
  const UniqueFd probe(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0));
  sockaddr_in address = local(0);
  socklen_t size = sizeof address;
  REQUIRE(::bind(probe.get(), reinterpret_cast<sockaddr*>(&address), size) == 0);
  REQUIRE(::getsockname(probe.get(), reinterpret_cast<sockaddr*>(&address), &size) == 0);
  return ntohs(address.sin_port);
}

/// A client with no manners: says what it is told to, byte for byte.
class Client {
 public:
  explicit Client(int port) : socket_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    const sockaddr_in address = local(port);
    connected_ =
        ::connect(socket_.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
  }
  [[nodiscard]] bool connected() const { return connected_; }
  void say(const std::string& text) const {
    static_cast<void>(::send(socket_.get(), text.data(), text.size(), MSG_NOSIGNAL));
  }
  void done_saying() const { ::shutdown(socket_.get(), SHUT_WR); }
  /// Reads until the server closes or `part` has come. @return all of it.
  std::string hear(const std::string& part = {},
                   std::chrono::milliseconds patience = std::chrono::seconds{60}) {
    const auto until = std::chrono::steady_clock::now() + patience;
    while (part.empty() || heard_.find(part) == std::string::npos) {
      const auto left =
          std::chrono::ceil<std::chrono::milliseconds>(until - std::chrono::steady_clock::now());
      pollfd waiting{socket_.get(), POLLIN, 0};
      if (left.count() <= 0 || ::poll(&waiting, 1, static_cast<int>(left.count())) <= 0) break;
      char bytes[65536];
      const ssize_t got = ::recv(socket_.get(), bytes, sizeof bytes, 0);
      if (got <= 0) {
        closed_ = true;
        break;
      }
      heard_.append(bytes, static_cast<std::size_t>(got));
    }
    return heard_;
  }
  [[nodiscard]] bool closed() const { return closed_; }

 private:
  UniqueFd socket_;
  bool connected_ = false;
  bool closed_ = false;
  std::string heard_;
};

/// One request's whole answer.
inline std::string answer_to(int port, const std::string& request) {
  Client client(port);
  client.say(request);
  client.done_saying();
  return client.hear();
}
inline std::string get(int port, const std::string& path) {
  return answer_to(port, "GET " + path + " HTTP/1.1\r\nHost: localhost\r\n\r\n");
}
inline std::string body_of(const std::string& answer) {
  const auto end = answer.find("\r\n\r\n");
  return end == std::string::npos ? "" : answer.substr(end + 4);
}

}  // namespace gyrocal::status
