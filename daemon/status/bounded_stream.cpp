#include "daemon/status/bounded_stream.h"

#include <poll.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>

namespace gyrocal::status {
namespace {

using SteadyClock = std::chrono::steady_clock;
constexpr std::size_t received_at_once = 4096;

}  // namespace

BoundedStream::BoundedStream(socket_t client, int stop_fd, std::chrono::milliseconds request_within,
                             std::chrono::milliseconds write_within)
    : client_(client),
      stop_fd_(stop_fd),
      request_until_(SteadyClock::now() + request_within),
      write_within_(write_within) {}

bool BoundedStream::waits_for(short events, Deadline until) const {
  for (;;) {
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(until - SteadyClock::now());
    if (left.count() <= 0) return false;
    std::array<pollfd, 2> watched{{{client_, events, 0}, {stop_fd_, POLLIN, 0}}};
    const int ready = ::poll(watched.data(), watched.size(), static_cast<int>(left.count()));
    if (ready < 0 && errno == EINTR) continue;
    if (ready <= 0 || watched[1].revents != 0) return false;
    return true;
  }
}

bool BoundedStream::is_readable() const {
  return read_ < received_.size() || waits_for(POLLIN, request_until_);
}

/// Asked before each piece of an endless answer: whether the client is still there.
bool BoundedStream::is_writable() const {
  std::array<pollfd, 2> watched{{{client_, POLLRDHUP, 0}, {stop_fd_, POLLIN, 0}}};
  return ::poll(watched.data(), watched.size(), 0) == 0;
}

ssize_t BoundedStream::refill() {
  if (!waits_for(POLLIN, request_until_)) return -1;
  received_.resize(received_at_once);
  const ssize_t got = ::recv(client_, received_.data(), received_.size(), MSG_DONTWAIT);
  received_.resize(got > 0 ? static_cast<std::size_t>(got) : 0);
  read_ = 0;
  return got;
}

ssize_t BoundedStream::read(char* into, size_t size) {
  if (read_ == received_.size()) {
    const ssize_t got = refill();
    if (got <= 0) return got;
  }
  const std::size_t taken = std::min(size, received_.size() - read_);
  std::memcpy(into, received_.data() + read_, taken);
  read_ += taken;
  return static_cast<ssize_t>(taken);
}

ssize_t BoundedStream::write(const char* from, size_t size) {
  const Deadline until = SteadyClock::now() + write_within_;
  std::size_t sent = 0;
  while (sent < size) {
    if (!waits_for(POLLOUT, until)) return -1;
    const ssize_t went = ::send(client_, from + sent, size - sent, MSG_NOSIGNAL | MSG_DONTWAIT);
    if (went < 0 && errno != EAGAIN && errno != EINTR) return -1;
    if (went > 0) sent += static_cast<std::size_t>(went);
  }
  return static_cast<ssize_t>(size);
}

void BoundedStream::get_remote_ip_and_port(std::string& ip, int& port) const {
  ip.clear();  // nothing we answer depends on who asks
  port = 0;
}

void BoundedStream::get_local_ip_and_port(std::string& ip, int& port) const {
  ip.clear();
  port = 0;
}

}  // namespace gyrocal::status
