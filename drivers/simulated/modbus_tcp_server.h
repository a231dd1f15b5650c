#pragma once

#include <poll.h>

#include <chrono>
#include <cstdint>
#include <functional>
#include <list>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "compensation/values/error.h"
#include "drivers/link.h"
#include "drivers/simulated/chamber_answer.h"
#include "drivers/tty_lock.h"

namespace gyrocal {

/// The server side of Modbus TCP for several clients in one thread, nothing of it blocking.
///
/// Not modbus_receive() and modbus_reply(): those block on half a request, take a request's length
/// from its function code, so that an unknown function leaves bytes for the next request, and
/// answer out of one array that has no holes and no refusals. Here a request is what the MBAP
/// header says, and the bytes of each client wait in a buffer of their own.
class ModbusTcpServer {
 public:
  using Handler = std::function<ChamberAnswer(std::span<const std::uint8_t> request)>;
  using WallTime = std::chrono::steady_clock::time_point;

  /// @param host  numeric IPv4 address.  @param port  0: any free one, see port().
  /// @return busy if somebody listens there, link_lost for the rest.
  [[nodiscard]] static Result<ModbusTcpServer> open(const std::string& host, int port);

  [[nodiscard]] int port() const { return port_; }
  [[nodiscard]] std::size_t client_count() const { return clients_.size(); }

  /// Refusing, it closes all connections and accepts none; the port stays ours.
  void set_refusing(bool refusing);

  /// Appends what to wait for.
  void watch(std::vector<pollfd>& into) const;
  /// When something must be done although nothing is ready: a late reply, a client that stopped
  /// in the middle of a request (it is dropped after a second).
  [[nodiscard]] std::optional<WallTime> deadline() const;
  /// Does what can be done at once.
  void serve(WallTime now, const Handler& handler);

 private:
  struct LateReply {
    WallTime due;
    Bytes bytes;
  };
  struct Client {
    UniqueFd fd;
    Bytes received;
    WallTime last_byte;
    std::list<LateReply> late;
  };

  ModbusTcpServer(UniqueFd listener, std::string host, int port);
  [[nodiscard]] static Result<UniqueFd> listen_at(const std::string& host, int port);
  void accept_clients();
  // Each returns false when the client has to go.
  [[nodiscard]] static bool receive(Client& client, WallTime now);
  [[nodiscard]] static bool answer_all(Client& client, WallTime now, const Handler& handler);
  [[nodiscard]] static bool give(Client& client, std::span<const std::uint8_t> header,
                                 const ChamberAnswer& answer, WallTime now);
  [[nodiscard]] static bool send_late(Client& client, WallTime now);
  [[nodiscard]] static bool send(const Client& client, std::span<const std::uint8_t> bytes);

  UniqueFd listener_;
  std::string host_;
  int port_;
  bool refusing_ = false;
  std::list<Client> clients_;
};

}  // namespace gyrocal
