// The feed against a real mosquitto; the subscriber is libmosquitto too.
#include "daemon/notify/broker.h"

#include <fmt/core.h>
#include <mosquitto.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <map>
#include <mutex>
#include <thread>

#include "tests/daemon/runner/temporary_folder.h"
#include "tests/daemon/status/http_client.h"

namespace gyrocal::notify {
namespace {

using namespace std::chrono_literals;

class RunningBroker {
 public:
  explicit RunningBroker(const runner::TemporaryFolder& folder, int port) {
    const std::string config = folder.write(
        "broker.conf",
        fmt::format("listener {} 127.0.0.1\nallow_anonymous true\npersistence false\n", port));
    pid_ = ::fork();
    if (pid_ != 0) return;
    static_cast<void>(::freopen((folder / "broker.log").c_str(), "a", stderr));
    ::execl(MOSQUITTO_PROGRAM, "mosquitto", "-c", config.c_str(), nullptr);
    ::_exit(127);
  }
  ~RunningBroker() {
    ::kill(pid_, SIGKILL);
    ::waitpid(pid_, nullptr, 0);
  }
  RunningBroker(const RunningBroker&) = delete;
  RunningBroker& operator=(const RunningBroker&) = delete;

 private:
  pid_t pid_;
};

/// Hears everything below a topic.
class Subscriber {
 public:
  explicit Subscriber(int port) {
    mosquitto_lib_init();
    handle_ = mosquitto_new(nullptr, true, this);
    mosquitto_connect_callback_set(handle_, [](mosquitto* handle, void*, int) {
      mosquitto_subscribe(handle, nullptr, "lab/#", 1);
    });
    mosquitto_message_callback_set(handle_,
                                   [](mosquitto*, void* self, const mosquitto_message* message) {
                                     auto* const subscriber = static_cast<Subscriber*>(self);
                                     const std::lock_guard lock(subscriber->mutex_);
                                     subscriber->heard_[message->topic] =
                                         std::string(static_cast<const char*>(message->payload),
                                                     static_cast<std::size_t>(message->payloadlen));
                                   });
    for (int i = 0; i < 200; ++i) {
      if (mosquitto_connect(handle_, "127.0.0.1", port, 10) == MOSQ_ERR_SUCCESS) break;
      std::this_thread::sleep_for(50ms);
    }
    mosquitto_loop_start(handle_);
  }
  ~Subscriber() {
    mosquitto_disconnect(handle_);
    mosquitto_loop_stop(handle_, true);
    mosquitto_destroy(handle_);
  }
  Subscriber(const Subscriber&) = delete;
  Subscriber& operator=(const Subscriber&) = delete;

  [[nodiscard]] bool hears(const std::string& topic, const std::string& text) {
    for (int i = 0; i < 300; ++i) {
      {
        const std::lock_guard lock(mutex_);
        if (heard_[topic] == text) return true;
      }
      std::this_thread::sleep_for(50ms);
    }
    return false;
  }

 private:
  mosquitto* handle_ = nullptr;
  std::mutex mutex_;
  std::map<std::string, std::string> heard_;
};

MqttSettings settings_for(int port, const std::string& host = "127.0.0.1") {
  return {host, port, "lab", 10};
}

}  // namespace

SCENARIO("the feed says that it is there, what happens, and that it has gone") {
  const runner::TemporaryFolder folder;
  const int port = status::free_port();
  auto feed = Broker::connect(settings_for(port), "weekend");  // before there is a broker
  REQUIRE(feed);
  const RunningBroker running(folder, port);
  Subscriber subscriber(port);
  CHECK(subscriber.hears("lab/weekend/online", "1"));
  feed->status("{\"state\":\"soaking\"}");
  CHECK(subscriber.hears("lab/weekend/status", "{\"state\":\"soaking\"}"));
  feed->event({2'000'000'000, 0, "warning", "door", "opened"});
  CHECK(subscriber.hears("lab/weekend/event",
                         R"({"t_s":2.0,"severity":"warning","kind":"door","text":"opened"})"));
  feed.reset();
  CHECK(subscriber.hears("lab/weekend/online", "0"));
}

SCENARIO("a daemon that dies is reported by the broker") {
  const runner::TemporaryFolder folder;
  const int port = status::free_port();
  const RunningBroker running(folder, port);
  Subscriber subscriber(port);
  const pid_t child = ::fork();
  if (child == 0) {
    const auto feed = Broker::connect(settings_for(port), "weekend");
    std::this_thread::sleep_for(60s);
    ::_exit(0);
  }
  const bool there = subscriber.hears("lab/weekend/online", "1");
  ::kill(child, SIGKILL);
  ::waitpid(child, nullptr, 0);
  CHECK(there);
  CHECK(subscriber.hears("lab/weekend/online", "0"));
}

SCENARIO("a broker that is away, or nowhere, keeps nobody waiting") {
  for (const char* host : {"127.0.0.1", "192.0.2.1", "no-such-host.invalid"}) {
    INFO(host);
    auto feed = Broker::connect(settings_for(status::free_port(), host), "weekend");
    REQUIRE(feed);
    for (int i = 0; i < 10000; ++i) feed->status("{}");
    feed.reset();
  }
}

}  // namespace gyrocal::notify
