#pragma once

#include <poll.h>
#include <signal.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <utility>

namespace gyrocal::runner {

/// One run of the daemon as a child process.
class Daemon {
 public:
  Daemon(const std::string& campaign, const std::string& database, const std::string& notify = {}) {
    pid_ = ::fork();
    if (pid_ != 0) return;
    if (!notify.empty()) ::setenv("NOTIFY_SOCKET", notify.c_str(), 1);
    const std::string log = database + ".log";
    static_cast<void>(::freopen(log.c_str(), "a", stderr));
    ::execl(GYROCALD_PROGRAM, "gyrocald", campaign.c_str(), "--db", database.c_str(), nullptr);
    ::_exit(127);
  }
  ~Daemon() {
    if (pid_ <= 0) return;
    ::kill(pid_, SIGKILL);
    wait();
  }
  Daemon(const Daemon&) = delete;
  Daemon& operator=(const Daemon&) = delete;

  void signal(int number) const { ::kill(pid_, number); }
  /// The exit code; -1 if a signal ended it.
  int wait() {
    int status = 0;
    ::waitpid(std::exchange(pid_, -1), &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

 private:
  pid_t pid_;
};

/// What a unit's NOTIFY_SOCKET hears.
class NotifySocket {
 public:
  explicit NotifySocket(const std::string& path) : fd_(::socket(AF_UNIX, SOCK_DGRAM, 0)) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    std::memcpy(address.sun_path, path.data(), path.size());
    REQUIRE(::bind(fd_, reinterpret_cast<sockaddr*>(&address), sizeof address) == 0);
  }
  ~NotifySocket() { ::close(fd_); }
  NotifySocket(const NotifySocket&) = delete;
  NotifySocket& operator=(const NotifySocket&) = delete;

  /// Waits until a message with `part` has come; gives up after `patience`.
  bool hears(const std::string& part,
             std::chrono::milliseconds patience = std::chrono::seconds{30}) {
    const auto deadline = std::chrono::steady_clock::now() + patience;
    while (heard_.find(part) == std::string::npos) {
      pollfd waiting{fd_, POLLIN, 0};
      const auto left =
          std::chrono::ceil<std::chrono::milliseconds>(deadline - std::chrono::steady_clock::now());
      if (left.count() <= 0) return false;
      if (::poll(&waiting, 1, static_cast<int>(left.count())) <= 0) continue;
      char bytes[512];
      const ssize_t got = ::recv(fd_, bytes, sizeof bytes, 0);
      if (got > 0) heard_.append(bytes, static_cast<std::size_t>(got)).append("\n");
    }
    return true;
  }

  /// What was heard so far does not count any more.
  void forget() { heard_.clear(); }

 private:
  int fd_;
  std::string heard_;
};

}  // namespace gyrocal::runner
