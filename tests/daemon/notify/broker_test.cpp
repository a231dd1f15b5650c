// The feed against a real mosquitto; the subscriber is libmosquitto too.
#include "daemon/notify/broker.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <mosquitto.h>
#include <signal.h>
#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <map>
#include <mutex>
#include <thread>

#include "config/text_file.h"
#include "tests/daemon/runner/temporary_folder.h"
#include "tests/daemon/status/http_client.h"

namespace gyrocal::notify {
namespace {

using namespace std::chrono_literals;

class RunningBroker {
 public:
  /// @param more  of its configuration: another listener.
  RunningBroker(const runner::TemporaryFolder& folder, int port, const std::string& more = "") {
    const std::string config = folder.write(
        "broker.conf", fmt::format("per_listener_settings true\nuser root\npersistence false\n"
                                   "listener {} 127.0.0.1\nallow_anonymous true\n{}",
                                   port, more));
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
  MqttSettings settings;
  settings.host = host;
  settings.port = port;
  settings.topic = "lab";
  return settings;
}

/// What is written to stderr while it lives, in a file.
class Stderr {
 public:
  explicit Stderr(std::string path) : path_(std::move(path)), before_(::dup(STDERR_FILENO)) {
    const int file = ::open(path_.c_str(), O_CREAT | O_WRONLY | O_APPEND, 0600);
    ::dup2(file, STDERR_FILENO);
    ::close(file);
    spdlog::set_default_logger(std::make_shared<spdlog::logger>(  // as gyrocald sets it
        "gyrocald", std::make_shared<spdlog::sinks::stderr_sink_mt>()));
  }
  ~Stderr() {
    ::dup2(before_, STDERR_FILENO);
    ::close(before_);
  }
  Stderr(const Stderr&) = delete;
  Stderr& operator=(const Stderr&) = delete;
  [[nodiscard]] bool says(const std::string& text) const {
    for (int i = 0; i < 300; ++i) {
      if (all().find(text) != std::string::npos) return true;
      std::this_thread::sleep_for(50ms);
    }
    return false;
  }
  [[nodiscard]] std::string all() const { return read_text_file(path_).value(); }

 private:
  std::string path_;
  int before_;
};

void made_by(const std::string& command) {
  INFO(command);
  REQUIRE(std::system((command + " >/dev/null 2>&1").c_str()) == 0);
}

/// A certificate for 127.0.0.1 that vouches for itself.
void make_certificate(const std::string& base) {
  made_by(
      "openssl req -x509 -newkey ec -pkeyopt ec_paramgen_curve:P-256 -nodes -days 2 "
      "-subj /CN=127.0.0.1 -addext subjectAltName=IP:127.0.0.1 -keyout " +
      base + ".key -out " + base + ".pem");
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

SCENARIO("a broker that asks who comes is told user and password, and nobody else is") {
  const runner::TemporaryFolder folder;
  const int open_port = status::free_port();
  const int port = status::free_port();
  made_by("mosquitto_passwd -b -c " + (folder / "passwords") + " gyrocal correct-horse");
  const RunningBroker running(
      folder, open_port,
      fmt::format("listener {} 127.0.0.1\npassword_file {}\n", port, folder / "passwords"));
  Subscriber subscriber(open_port);
  auto settings = settings_for(port);
  settings.user = "gyrocal";
  settings.password_file = folder / "mqtt.password";
  {
    const Stderr told(folder / "stderr");
    auto feed = Broker::connect(settings, "weekend");
    CHECK(told.says("mqtt.password"));  // it does not exist yet
    static_cast<void>(folder.write("mqtt.password", "battery-staple\n"));
    CHECK(told.says("not authori"));
    static_cast<void>(folder.write("mqtt.password", "correct-horse\n"));
    CHECK(subscriber.hears("lab/weekend/online", "1"));
    feed->status("{}");
    CHECK(subscriber.hears("lab/weekend/status", "{}"));
    feed.reset();
    CHECK(subscriber.hears("lab/weekend/online", "0"));
    CHECK(told.all().find("horse") == std::string::npos);
    CHECK(told.all().find("staple") == std::string::npos);
  }
}

SCENARIO("with TLS a broker is believed only by the certificate it was to have") {
  const runner::TemporaryFolder folder;
  const int open_port = status::free_port();
  const int port = status::free_port();
  make_certificate(folder / "broker");
  make_certificate(folder / "another");
  const RunningBroker running(
      folder, open_port,
      fmt::format("listener {} 127.0.0.1\nallow_anonymous true\ncertfile {}\nkeyfile {}\n", port,
                  folder / "broker.pem", folder / "broker.key"));
  Subscriber subscriber(open_port);
  auto settings = settings_for(port);
  settings.tls = true;
  settings.ca_file = folder / "ca.pem";
  static_cast<void>(folder.write("ca.pem", read_text_file(folder / "another.pem").value()));
  const Stderr told(folder / "stderr");
  auto feed = Broker::connect(settings, "weekend");
  CHECK(told.says("is not believed"));
  static_cast<void>(folder.write("ca.pem", read_text_file(folder / "broker.pem").value()));
  CHECK(subscriber.hears("lab/weekend/online", "1"));
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
