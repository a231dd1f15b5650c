#pragma once

#include <memory>
#include <string>

#include "compensation/values/error.h"
#include "daemon/status/feed.h"

namespace gyrocal::status {

/// Answers GET and HEAD from the newest view of a feed, in its own threads, and every other method
/// with 405. It takes at most `clients_max` connections at a time, the others wait in the kernel's
/// queue; one request a connection; a client too slow to ask or to listen is cut off.
///
///   /             the page                     /api/status   where the campaign stands
///   /numbers      its numbers alone, as HTML   /api/events   the latest events
///   /metrics      for Prometheus               /api/history  what the plots show
///   /api/stream   server-sent events: status (as /api/status), numbers (as /numbers)
class HttpServer {
 public:
  /// @param feed  outlives the server.
  /// @return busy: the address is taken; out_of_range: it is none of this machine's.
  [[nodiscard]] static Result<std::unique_ptr<HttpServer>> start(const Feed& feed,
                                                                 const std::string& address,
                                                                 int port);
  virtual ~HttpServer() = default;

  static constexpr int clients_max = 24;
  static constexpr int streams_max = 12;  ///< of them; a page beyond that asks now and then
};

}  // namespace gyrocal::status
