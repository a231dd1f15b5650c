#pragma once

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <deque>
#include <map>
#include <thread>
#include <vector>

#include "drivers/big_endian.h"
#include "drivers/chamber/pdu.h"
#include "drivers/tty_lock.h"

namespace gyrocal::test {

/// What a server does with one request.
enum class Deed {
  answer,
  answer_late,
  half,
  twice,
  other_unit,
  other_register,
  refuse,
  hang_up,
  web_page
};

/// A Modbus TCP server on loopback with all registers, whose next replies are as bad as a test
/// wants. Written on sockets, so that it shares nothing with the client under test but the PDUs.
class TestServer {
 public:
  explicit TestServer(std::deque<Deed> deeds) : deeds_(std::move(deeds)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    auto* const any = reinterpret_cast<sockaddr*>(&address);
    REQUIRE(bind(listening_.get(), any, size) == 0);
    REQUIRE(listen(listening_.get(), 8) == 0);
    REQUIRE(getsockname(listening_.get(), any, &size) == 0);
    port = ntohs(address.sin_port);
    thread_ = std::thread([this] { serve(); });
  }
  ~TestServer() {
    eventfd_write(stop_.get(), 1);
    thread_.join();
  }
  TestServer(const TestServer&) = delete;
  TestServer& operator=(const TestServer&) = delete;

  int port = 0;

 private:
  void serve() {
    for (;;) {
      std::vector<pollfd> ready{{stop_.get(), POLLIN, 0}, {listening_.get(), POLLIN, 0}};
      for (const auto& client : clients_) ready.push_back({client.get(), POLLIN, 0});
      poll(ready.data(), ready.size(), -1);
      if (ready[0].revents != 0) return;
      for (std::size_t i = 2; i < ready.size(); ++i) {
        if (ready[i].revents != 0 && !attend(i - 2)) break;  // the list has changed
      }
      if (ready[1].revents != 0) clients_.emplace_back(accept(listening_.get(), nullptr, nullptr));
    }
  }

  bool attend(std::size_t index) {
    const int client = clients_[index].get();
    Bytes frame(260);
    const ssize_t count = recv(client, frame.data(), frame.size(), 0);
    if (count <= 6) return leave(index);
    frame.resize(static_cast<std::size_t>(count));
    const Deed deed = deeds_.empty() ? Deed::answer : deeds_.front();
    if (!deeds_.empty()) deeds_.pop_front();
    if (!late_.empty()) send_to(late_client_, std::exchange(late_, {}));
    const Bytes reply = reply_to(frame, deed);
    if (deed == Deed::hang_up) return leave(index);
    if (deed == Deed::answer_late) {
      late_ = reply;
      late_client_ = client;
    } else {
      send_to(client, reply);
    }
    return true;
  }

  bool leave(std::size_t index) {
    if (clients_[index].get() == late_client_) late_.clear();
    clients_.erase(clients_.begin() + static_cast<std::ptrdiff_t>(index));
    return false;
  }

  static void send_to(int client, const Bytes& bytes) {
    [[maybe_unused]] const auto sent = send(client, bytes.data(), bytes.size(), MSG_NOSIGNAL);
  }

  Bytes reply_to(const Bytes& frame, Deed deed) {
    auto request = *modbus::decode_request(std::span(frame).subspan(6));
    modbus::Words words;
    for (int i = 0; i < request.count; ++i) {
      auto& word = registers_[static_cast<std::uint16_t>(request.address + i)];
      if (modbus::is_write(request)) word = request.values[static_cast<std::size_t>(i)];
      words.push_back(word);
    }
    if (deed == Deed::other_unit) ++request.unit;
    if (deed == Deed::other_register) ++request.address;
    Bytes pdu = modbus::is_write(request) ? modbus::encode_write_reply(request)
                                          : modbus::encode_read_reply(request, words);
    if (deed == Deed::refuse) {
      pdu = modbus::encode_exception(request.unit, request.function,
                                     modbus::Exception::illegal_address);
    }
    if (deed == Deed::web_page) {
      const std::string page = "HTTP/1.1 400 Bad Request\r\nContent-Length: 0\r\n\r\n";
      return {page.begin(), page.end()};
    }
    Bytes reply(frame.begin(), frame.begin() + 4);
    put_u16(reply, static_cast<std::uint16_t>(pdu.size()));
    reply.insert(reply.end(), pdu.begin(), pdu.end());
    if (deed == Deed::half) reply.resize(reply.size() / 2);
    if (deed == Deed::twice) {
      const Bytes once = reply;
      reply.insert(reply.end(), once.begin(), once.end());
    }
    return reply;
  }

  std::deque<Deed> deeds_;
  std::map<std::uint16_t, std::uint16_t> registers_;
  UniqueFd listening_{socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)};
  UniqueFd stop_{eventfd(0, EFD_CLOEXEC)};
  std::vector<UniqueFd> clients_;
  Bytes late_;
  int late_client_ = -1;
  std::thread thread_;
};

}  // namespace gyrocal::test
