#pragma once

#include <httplib.h>

#include <chrono>
#include <string>

namespace gyrocal::status {

/// One client's connection, with an end to everybody's patience: the whole request must have come
/// within `request_within` of the start, and each write must be taken whole within `write_within`.
/// httplib's own timeouts begin anew with each byte, so that a client that sends or reads one now
/// and then holds a thread for hours. Both end at once when `stop_fd` becomes readable.
class BoundedStream final : public httplib::Stream {
 public:
  BoundedStream(socket_t client, int stop_fd, std::chrono::milliseconds request_within,
                std::chrono::milliseconds write_within);

  [[nodiscard]] bool is_readable() const override;
  [[nodiscard]] bool is_writable() const override;
  ssize_t read(char* into, size_t size) override;
  ssize_t write(const char* from, size_t size) override;
  void get_remote_ip_and_port(std::string& ip, int& port) const override;
  void get_local_ip_and_port(std::string& ip, int& port) const override;
  [[nodiscard]] socket_t socket() const override { return client_; }

 private:
  using Deadline = std::chrono::steady_clock::time_point;
  [[nodiscard]] bool waits_for(short events, Deadline until) const;
  [[nodiscard]] ssize_t refill();

  socket_t client_;
  int stop_fd_;
  Deadline request_until_;
  std::chrono::milliseconds write_within_;
  std::string received_;  ///< not yet read; httplib asks byte by byte
  std::size_t read_ = 0;
};

}  // namespace gyrocal::status
