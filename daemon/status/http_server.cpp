#include "daemon/status/http_server.h"

#include <fmt/core.h>
#include <signal.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdint>
#include <map>
#include <string_view>
#include <system_error>
#include <thread>

#include "daemon/status/blocked_signals.h"
#include "daemon/status/bounded_stream.h"
#include "daemon/status/metrics.h"
#include "daemon/status/numbers.h"
#include "daemon/status/server_sent_events.h"
#include "daemon/status/status_json.h"
#include "daemon/status/waiting_pool.h"
#include "daemon/status/web_files.h"
#include "drivers/tty_lock.h"  // UniqueFd

namespace gyrocal::status {
namespace {

using httplib::Request;
using httplib::Response;

constexpr std::chrono::seconds request_within{2};
constexpr std::chrono::seconds write_within{10};
/// Of the server: so long the streams may take to tell how the campaign ended.
constexpr std::chrono::milliseconds last_words_within{500};
constexpr std::chrono::seconds heard_at_least_every{15};
constexpr std::size_t body_bytes_max = 1024;  ///< nobody has anything to send

constexpr char html[] = "text/html; charset=utf-8";
constexpr char json[] = "application/json";

/// httplib's server on connections with an end, and without its ranges: a request for a thousand
/// overlapping ones would be answered with a thousand copies.
class Server final : public httplib::Server {
 public:
  explicit Server(int stop_fd) : stop_fd_(stop_fd) {}

 private:
  bool process_and_close_socket(socket_t client) override {
    const UniqueFd owned(client);
    BoundedStream stream(client, stop_fd_, request_within, write_within);
    bool closed = false;
    try {
      process_request(stream, true, closed, [](Request& request) { request.ranges.clear(); });
    } catch (const std::exception&) {
      // What httplib throws over a malformed request must not end the daemon; the client is cut.
    }
    ::shutdown(client, SHUT_WR);
    return true;
  }
  int stop_fd_;
};

class Serving final : public HttpServer {
 public:
  explicit Serving(const Feed& feed)
      : feed_(feed), stop_fd_(::eventfd(0, EFD_CLOEXEC)), server_(stop_fd_.get()) {
    server_.new_task_queue = [] { return new WaitingPool(clients_max); };
    server_.set_payload_max_length(body_bytes_max);
    // Not SO_REUSEPORT, httplib's default: with it two daemons would share a port by turns.
    server_.set_socket_options([](socket_t listener) {
      const int yes = 1;
      ::setsockopt(listener, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
    });
    server_.set_default_headers({{"Cache-Control", "no-store"},
                                 {"X-Content-Type-Options", "nosniff"},
                                 {"Content-Security-Policy",
                                  "default-src 'self'; style-src 'self' 'unsafe-inline'; img-src "
                                  "'self' data:; frame-ancestors 'none'"}});
    server_.set_pre_routing_handler([this](const Request& request, Response& response) {
      answer(request, response);
      return httplib::Server::HandlerResponse::Handled;
    });
  }
  ~Serving() override {
    const auto until = std::chrono::steady_clock::now() + last_words_within;
    while (streams_ > 0 && std::chrono::steady_clock::now() < until) {
      std::this_thread::sleep_for(std::chrono::milliseconds{5});
    }
    const std::uint64_t one = 1;
    static_cast<void>(!::write(stop_fd_.get(), &one, sizeof one));
    server_.stop();
    if (listening_.joinable()) listening_.join();
  }

  [[nodiscard]] Result<void> listen(const std::string& address, int port) {
    if (!server_.bind_to_port(address, port)) {
      const int code = errno;
      return fail(code == EADDRINUSE ? Errc::busy : Errc::out_of_range,
                  fmt::format("serve the status page on {}:{}: {}", address, port,
                              std::generic_category().message(code)),
                  "set another port or address under [status] in gyrocald.toml");
    }
    const BlockedSignals for_new_threads;
    listening_ = std::thread([this] { server_.listen_after_bind(); });
    while (!server_.is_running()) std::this_thread::yield();  // else stop() would find nothing
    return {};
  }

 private:
  void answer(const Request& request, Response& response);
  void stream(const Request& request, Response& response);

  const Feed& feed_;
  UniqueFd stop_fd_;
  std::atomic<int> streams_ = 0;
  Server server_;
  std::thread listening_;
};

void Serving::answer(const Request& request, Response& response) {
  if (request.method != "GET" && request.method != "HEAD") {
    response.status = 405;
    response.set_header("Allow", "GET, HEAD");
    response.set_content("This page can be read, nothing can be changed through it.\n",
                         "text/plain");
    return;
  }
  const auto view = feed_.latest();
  response.status = 200;
  if (request.path == "/") return response.set_content(page_html(*view), html);
  if (request.path == "/numbers") return response.set_content(numbers_html(*view), html);
  if (request.path == "/metrics") {
    return response.set_content(metrics_text(*view), "text/plain; version=0.0.4; charset=utf-8");
  }
  if (request.path == "/api/status") return response.set_content(status_json(*view), json);
  if (request.path == "/api/events") return response.set_content(events_json(*view), json);
  if (request.path == "/api/history") return response.set_content(history_json(*view), json);
  if (request.path == "/api/stream") return stream(request, response);
  if (const WebFile* file = web_file(request.path)) {
    return response.set_content(file->text.data(), file->text.size(), file->type);
  }
  response.status = 404;
  response.set_content("Not here; see / for the page and what it links to.\n", "text/plain");
}

void Serving::stream(const Request& request, Response& response) {
  if (request.method == "HEAD") return response.set_content("", "text/event-stream");
  if (streams_.fetch_add(1) >= streams_max) {
    --streams_;
    response.status = 503;
    response.set_header("Retry-After", "30");
    response.set_content("Too many pages are open; ask for /api/status now and then.\n",
                         "text/plain");
    return;
  }
  response.set_chunked_content_provider(
      "text/event-stream",
      [this, sent = std::uint64_t{0}](std::size_t, httplib::DataSink& sink) mutable {
        const auto view = feed_.newer_than(sent, heard_at_least_every);
        if (!view) return false;
        const std::string text =
            view->version > sent ? server_sent_events(*view) : ": still here\n\n";
        sent = view->version;
        return sink.write(text.data(), text.size());
      },
      [this](bool) { --streams_; });
}

}  // namespace

Result<std::unique_ptr<HttpServer>> HttpServer::start(const Feed& feed, const std::string& address,
                                                      int port) {
  auto serving = std::make_unique<Serving>(feed);
  if (auto listening = serving->listen(address, port); !listening) {
    return tl::unexpected(listening.error());
  }
  return serving;
}

}  // namespace gyrocal::status
