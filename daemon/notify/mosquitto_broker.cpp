#include <mosquitto.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <thread>

#include "config/text_file.h"
#include "daemon/notify/broker.h"
#include "daemon/status/blocked_signals.h"
#include "daemon/status/json_text.h"

namespace gyrocal::notify {
namespace {

constexpr int keep_alive_s = 30;
constexpr int loop_ms = 1000;
constexpr unsigned retry_s_min = 1;
constexpr unsigned retry_s_max = 60;
constexpr int at_least_once = 1;
constexpr int at_most_once = 0;
constexpr bool retained = true;
constexpr std::chrono::milliseconds farewell_within{1000};

struct Destroy {
  void operator()(mosquitto* handle) const noexcept { mosquitto_destroy(handle); }
};

/// The connection and all that its thread touches: it outlives the broker where the thread still
/// waits for an address that does not answer.
class Connection {
 public:
  Connection(const MqttSettings& settings, const std::string& campaign)
      : settings_(settings), topic_(settings.topic + "/" + campaign) {
    static std::once_flag once;
    std::call_once(once, [] { mosquitto_lib_init(); });
    handle_.reset(mosquitto_new(nullptr, true, this));
  }

  [[nodiscard]] bool prepare() {
    if (!handle_) return false;
    mosquitto_connect_callback_set(handle_.get(), [](mosquitto*, void* self, int refused) {
      static_cast<Connection*>(self)->on_connect(refused);
    });
    mosquitto_disconnect_callback_set(handle_.get(), [](mosquitto*, void* self, int why) {
      static_cast<Connection*>(self)->on_disconnect(why);
    });
    mosquitto_publish_callback_set(handle_.get(), [](mosquitto*, void* self, int) {
      ++static_cast<Connection*>(self)->delivered_;
    });
    mosquitto_reconnect_delay_set(handle_.get(), retry_s_min, retry_s_max, true);
    mosquitto_will_set(handle_.get(), (topic_ + "/online").c_str(), 1, "0", at_least_once,
                       retained);
    return mosquitto_threaded_set(handle_.get(), true) == MOSQ_ERR_SUCCESS;
  }

  /// Until stop(). mosquitto_loop_start() would not come back to a broker that was away at first.
  void run() {
    unsigned retry_s = retry_s_min;
    std::unique_lock lock(mutex_);
    while (!stopping_) {
      lock.unlock();
      welcome_ = false;
      attempt();
      lock.lock();
      if (welcome_) retry_s = retry_s_min;
      changed_.wait_for(lock, std::chrono::seconds{retry_s}, [this] { return stopping_; });
      if (!welcome_) retry_s = std::min(2 * retry_s, retry_s_max);
    }
    ended_ = true;
    changed_.notify_all();
  }

  /// Says farewell. @return whether run() has come to its end within a second.
  [[nodiscard]] bool stop() {
    if (connected_) {
      const int before = delivered_;
      publish("online", "0", at_least_once, retained);
      const auto until = std::chrono::steady_clock::now() + farewell_within;
      while (delivered_ == before && std::chrono::steady_clock::now() < until) {
        std::this_thread::sleep_for(std::chrono::milliseconds{5});
      }
    }
    std::unique_lock lock(mutex_);
    stopping_ = true;
    changed_.notify_all();
    mosquitto_disconnect(handle_.get());
    return changed_.wait_for(lock, farewell_within, [this] { return ended_; });
  }

  void publish(const char* below, const std::string& text, int quality, bool retain) {
    if (!connected_) return;
    mosquitto_publish(handle_.get(), nullptr, (topic_ + "/" + below).c_str(),
                      static_cast<int>(text.size()), text.data(), quality, retain);
  }

 private:
  /// Logs in and stays until the connection is gone for good. Files are read anew each time:
  /// whoever mends a password while the campaign runs need not restart it.
  void attempt() {
    if (const auto ready = log_in(); !ready) return tell(to_text(ready.error()));
    int ended =
        mosquitto_connect(handle_.get(), settings_.host.c_str(), settings_.port, keep_alive_s);
    if (ended == MOSQ_ERR_SUCCESS) ended = mosquitto_loop_forever(handle_.get(), loop_ms, 1);
    switch (ended) {
      case MOSQ_ERR_SUCCESS:
      case MOSQ_ERR_NO_CONN:
      case MOSQ_ERR_CONN_LOST:
      case MOSQ_ERR_CONN_REFUSED:  // told where it happened
        return;
      case MOSQ_ERR_ERRNO:
        return tell("it does not answer");
      case MOSQ_ERR_TLS:
        return tell("its certificate is not believed: is it for this host, and signed by ca_file?");
      default:
        return tell(mosquitto_strerror(ended));
    }
  }
  [[nodiscard]] Result<void> log_in() {
    if (settings_.user) {
      std::string password;
      if (settings_.password_file) {
        auto text = read_text_file(*settings_.password_file);
        if (!text) return tl::unexpected(std::move(text.error()));
        password = text->substr(0, text->find_first_of("\r\n"));
      }
      mosquitto_username_pw_set(handle_.get(), settings_.user->c_str(),
                                settings_.password_file ? password.c_str() : nullptr);
    }
    if (!settings_.tls || secured_) return {};
    const int set = settings_.ca_file
                        ? mosquitto_tls_set(handle_.get(), settings_.ca_file->c_str(), nullptr,
                                            nullptr, nullptr, nullptr)
                        : mosquitto_int_option(handle_.get(), MOSQ_OPT_TLS_USE_OS_CERTS, 1);
    secured_ = set == MOSQ_ERR_SUCCESS;
    if (secured_) return {};
    return fail(Errc::storage, "ca_file " + settings_.ca_file.value_or("") + " cannot be read");
  }
  /// A trouble that lasts is told once.
  void tell(const std::string& trouble) {
    if (trouble == told_) return;
    told_ = trouble;
    spdlog::warn("no feed to broker {}, it is tried again: {}", settings_.host, trouble);
  }

  void on_connect(int refused) {
    if (refused != 0) {
      tell(mosquitto_connack_string(refused));
      mosquitto_disconnect(handle_.get());  // else the same password is tried again and again
      return;
    }
    told_.clear();
    welcome_ = true;
    connected_ = true;
    publish("online", "1", at_least_once, retained);
  }
  void on_disconnect(int why) {
    const bool was = connected_.exchange(false);
    if (was && why != 0) {
      spdlog::warn("broker {} is away; it is tried again", settings_.host);
    }
  }

  MqttSettings settings_;
  std::string topic_;
  std::atomic<bool> connected_ = false;
  std::atomic<int> delivered_ = 0;
  bool secured_ = false;  // this and the next two: only in the thread of run()
  bool welcome_ = false;
  std::string told_;
  std::mutex mutex_;
  std::condition_variable changed_;
  bool stopping_ = false;
  bool ended_ = false;
  std::unique_ptr<mosquitto, Destroy> handle_;
};

class MosquittoBroker final : public Broker {
 public:
  explicit MosquittoBroker(std::shared_ptr<Connection> connection)
      : connection_(std::move(connection)) {
    const status::BlockedSignals for_new_threads;
    thread_ = std::thread([held = connection_] { held->run(); });
  }
  ~MosquittoBroker() override {
    if (connection_->stop()) {
      thread_.join();
    } else {
      thread_.detach();  // waits for an address that does not answer; it has its own hold
    }
  }

  void status(const std::string& json) override {
    connection_->publish("status", json, at_most_once, retained);
  }
  void event(const EventInsert& event) override {
    const nlohmann::ordered_json json{{"t_s", double(event.t_ns) * 1e-9},
                                      {"severity", event.severity},
                                      {"kind", event.kind},
                                      {"text", event.text}};
    connection_->publish("event", status::json_text(json), at_least_once, !retained);
  }

 private:
  std::shared_ptr<Connection> connection_;
  std::thread thread_;
};

}  // namespace

std::unique_ptr<Broker> Broker::connect(const MqttSettings& settings, const std::string& campaign) {
  auto connection = std::make_shared<Connection>(settings, campaign);
  if (connection->prepare()) return std::make_unique<MosquittoBroker>(std::move(connection));
  spdlog::warn("no feed to broker {}: libmosquitto has not started", settings.host);
  return nullptr;
}

}  // namespace gyrocal::notify
