#include "daemon/status/http_server.h"

#include <fmt/core.h>

#include <atomic>
#include <deque>
#include <filesystem>
#include <thread>
#include <vector>

#include "tests/daemon/status/http_client.h"
#include "tests/daemon/status/sample_view.h"

namespace gyrocal::status {
namespace {

struct Served {
  Served() : feed(sample_view()), port(free_port()) {
    auto started = HttpServer::start(feed, "127.0.0.1", port);
    if (!started) FAIL(to_text(started.error()));
    server = std::move(*started);
  }
  Feed feed;
  int port;
  std::unique_ptr<HttpServer> server;
};

std::size_t open_files() {
  std::size_t count = 0;
  for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator("/proc/self/fd")) {
    ++count;
  }
  return count;
}

std::string status_line(const std::string& answer) { return answer.substr(0, answer.find("\r\n")); }

}  // namespace

SCENARIO("every address answers, and HEAD says the same without a body") {
  const Served served;
  for (const char* path :
       {"/", "/numbers", "/metrics", "/api/status", "/api/events", "/api/history", "/page.css",
        "/page.js", "/dygraph.js", "/dygraph.css"}) {
    INFO(path);
    const std::string got = get(served.port, path);
    CHECK(status_line(got) == "HTTP/1.1 200 OK");
    CHECK_FALSE(body_of(got).empty());
    const std::string head =
        answer_to(served.port, fmt::format("HEAD {} HTTP/1.1\r\nHost: a\r\n\r\n", path));
    CHECK(status_line(head) == "HTTP/1.1 200 OK");
    CHECK(body_of(head).empty());
  }
  CHECK(status_line(get(served.port, "/nothing")) == "HTTP/1.1 404 Not Found");
}

SCENARIO("whatever would change something is refused") {
  const Served served;
  for (const char* method : {"POST", "PUT", "DELETE", "PATCH", "OPTIONS"}) {
    INFO(method);
    const std::string answer = answer_to(
        served.port,
        fmt::format("{} /api/status HTTP/1.1\r\nHost: a\r\nContent-Length: 0\r\n\r\n", method));
    CHECK(status_line(answer) == "HTTP/1.1 405 Method Not Allowed");
    CHECK(answer.find("Allow: GET, HEAD") != std::string::npos);
  }
}

SCENARIO("malformed requests end their connection and nothing else") {
  const Served served;
  const std::string long_line(20000, 'a');
  const std::string ranges = "bytes=0-" + [] {
    std::string many;
    for (int i = 0; i < 1500; ++i) many += ",0-";
    return many;
  }();
  for (const std::string& request :
       {std::string("\r\n\r\n"), std::string("nonsense\r\n\r\n"), std::string("GET\r\n\r\n"),
        std::string("GET / HTTP/9.9\r\n\r\n"), std::string(5000, '\0'),
        "GET /" + long_line + " HTTP/1.1\r\n\r\n", "GET / HTTP/1.1\r\nA: " + long_line + "\r\n\r\n",
        "GET /dygraph.js HTTP/1.1\r\nRange: " + ranges + "\r\n\r\n",
        std::string("GET / HTTP/1.1\r\nRange: bytes=99999999999999999999999-\r\n\r\n"),
        std::string("GET /%zz%00%ff HTTP/1.1\r\nHost: a\r\n\r\n"),
        std::string("POST / HTTP/1.1\r\nContent-Length: 99999999999999999999999\r\n\r\n"),
        std::string("POST / HTTP/1.1\r\nTransfer-Encoding: chunked\r\n\r\nffffffffffffffff\r\n"),
        std::string("GET /../../etc/passwd HTTP/1.1\r\nHost: a\r\n\r\n")}) {
    INFO(request.substr(0, 60));
    const std::string answer = answer_to(served.port, request);
    CHECK(answer.size() < 200000);
    CHECK(answer.find("root:") == std::string::npos);
  }
  CHECK(status_line(get(served.port, "/api/status")) == "HTTP/1.1 200 OK");
}

SCENARIO("a taken port is an error with advice, and is not shared") {
  const Served served;
  const Feed feed(sample_view());
  const auto second = HttpServer::start(feed, "127.0.0.1", served.port);
  REQUIRE_FALSE(second);
  CHECK(second.error().code == Errc::busy);
  CHECK(second.error().advice.find("[status] in gyrocald.toml") != std::string::npos);
  const auto elsewhere = HttpServer::start(feed, "192.0.2.77", free_port());
  REQUIRE_FALSE(elsewhere);
}

SCENARIO("the stream tells each new view, and the last one before the daemon ends") {
  Served served;
  Client page(served.port);
  page.say("GET /api/stream HTTP/1.1\r\nHost: a\r\n\r\n");
  CHECK(page.hear("event: numbers").find("\"state\":\"soaking\"") != std::string::npos);
  View next = sample_view();
  next.version = 2;
  next.now->state = "logging";
  served.feed.publish(next);
  CHECK(page.hear("\"state\":\"logging\"").find("\"state\":\"logging\"") != std::string::npos);
  next.version = 3;
  next.now->state = "finished";
  served.feed.publish(next);
  served.feed.close();
  served.server.reset();
  CHECK(page.hear().find("\"state\":\"finished\"") != std::string::npos);
  CHECK(page.closed());
}

SCENARIO("clients that never say a word, or never listen, do not keep the others out") {
  Served served;
  std::deque<Client> silent;
  for (int i = 0; i < 2 * HttpServer::clients_max; ++i) silent.emplace_back(served.port);
  Client slow(served.port);
  slow.say("GET / HT");
  std::deque<Client> deaf;
  for (int i = 0; i < HttpServer::streams_max; ++i) {
    deaf.emplace_back(served.port);
    deaf.back().say("GET /api/stream HTTP/1.1\r\nHost: a\r\n\r\n");
  }
  CHECK(status_line(get(served.port, "/api/status")) == "HTTP/1.1 200 OK");
  slow.hear();
  CHECK(slow.closed());
  const std::string refused = get(served.port, "/api/stream");
  CHECK(status_line(refused) == "HTTP/1.1 503 Service Unavailable");
  CHECK(refused.find("Retry-After: 30") != std::string::npos);
}

SCENARIO("a thousand clients cost a bounded number of descriptors") {
  Served served;
  const std::size_t before = open_files();
  constexpr int clients = 1000;
  std::atomic<int> answered = 0;
  std::size_t most = 0;
  {
    std::vector<std::thread> crowds;
    for (int crowd = 0; crowd < 10; ++crowd) {
      crowds.emplace_back([&] {
        for (int i = 0; i < clients / 10; ++i) {
          if (status_line(get(served.port, "/api/status")) == "HTTP/1.1 200 OK") ++answered;
        }
      });
    }
    while (answered < clients / 2) most = std::max(most, open_files());
    for (auto& crowd : crowds) crowd.join();
  }
  CHECK(answered == clients);
  // Ten of the crowd's own, as many at the server, and the one being accepted.
  CHECK(most <= before + 10 + HttpServer::clients_max + 2);
}

SCENARIO("a server with clients that hang ends all the same") {
  auto served = std::make_unique<Served>();
  std::deque<Client> silent;
  for (int i = 0; i < 200; ++i) {
    silent.emplace_back(served->port);
    silent.back().say(i % 2 == 0 ? "GET /api/stream HTTP/1.1\r\n\r\n" : "GET");
  }
  served->feed.close();
  served.reset();
  CHECK(silent.size() == 200);
}

}  // namespace gyrocal::status
