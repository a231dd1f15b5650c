#include "daemon/notify/notifier.h"

#include <spdlog/spdlog.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <condition_variable>
#include <limits>
#include <mutex>
#include <thread>

#include "daemon/notify/broker.h"
#include "daemon/notify/hook.h"
#include "daemon/notify/outbox.h"
#include "daemon/notify/watcher.h"
#include "daemon/status/blocked_signals.h"
#include "daemon/status/status_json.h"
#include "drivers/clocks.h"

namespace gyrocal::notify {
namespace {

constexpr std::chrono::milliseconds look_every{200};
constexpr double last_try_s = 20;      ///< of all messages together when the daemon ends
constexpr double alive_within_s = 60;  ///< the loop reported: there is a heart to beat

std::string this_host() {
  std::array<char, 256> name{};
  if (::gethostname(name.data(), name.size() - 1) != 0) return "unknown";
  return name.data();
}

std::chrono::milliseconds milliseconds(double s) {
  return std::chrono::milliseconds{static_cast<std::int64_t>(s * 1000)};
}

class Working final : public Notifier {
 public:
  Working(const DaemonSettings& settings, status::Facts facts)
      : settings_(settings),
        live_(std::move(facts)),
        watcher_(settings.notify.outage_s, settings.notify.behind_s),
        outbox_(settings.notify.messages_per_hour_max, settings.notify.hook_attempts) {
    if (settings.mqtt) broker_ = Broker::connect(*settings.mqtt, first_view().facts.campaign);
    const status::BlockedSignals for_new_threads;
    thread_ = std::thread([this] { work(); });
  }
  ~Working() override {
    {
      const std::lock_guard lock(mutex_);
      stopping_ = true;
    }
    wake_.notify_all();
    thread_.join();
  }
  status::Mailbox& mailbox() override { return mailbox_; }

 private:
  [[nodiscard]] double now_s() const { return to_seconds(clock_.now().time_since_epoch()); }
  [[nodiscard]] const status::View& first_view() { return live_.at(clock_.utc_ns(), now_s()); }
  void work();
  void look();
  void deliver();
  void beat(const status::View& view);
  void feed(const status::View& view);
  [[nodiscard]] Result<void> send(const Outbox::Message& message, double within_s) const;
  void last_try();

  DaemonSettings settings_;
  ScaledClock clock_;
  status::Mailbox mailbox_;
  status::LiveStatus live_;
  Watcher watcher_;
  Outbox outbox_;
  std::unique_ptr<Broker> broker_;
  std::string host_ = this_host();
  double next_beat_s_ = 0;
  bool beat_failed_ = false;
  double next_feed_s_ = 0;
  std::mutex mutex_;
  std::condition_variable wake_;
  bool stopping_ = false;
  std::thread thread_;
};

void Working::work() {
  std::unique_lock lock(mutex_);
  while (!stopping_) {
    lock.unlock();
    look();
    deliver();
    lock.lock();
    wake_.wait_for(lock, look_every, [this] { return stopping_; });
  }
  lock.unlock();
  look();
  last_try();
  if (broker_) broker_->status(status::status_json(live_.at(clock_.utc_ns(), now_s())));
  broker_.reset();
}

void Working::look() {
  const auto content = mailbox_.take();
  live_.report(content, now_s());
  for (const EventInsert& event : content.events) {
    if (broker_) broker_->event(event);
  }
  const status::View& view = live_.at(clock_.utc_ns(), now_s());
  for (const Notice& notice : watcher_.look(view, now_s())) {
    if (!settings_.notify.hook || !outbox_.admits(notice.kind, now_s())) continue;
    outbox_.add({subject(notice, view.facts.campaign), notice.kind,
                 notice_json(notice, view, host_, outbox_.take_withheld())});
  }
  beat(view);
  feed(view);
}

Result<void> Working::send(const Outbox::Message& message, double within_s) const {
  return run_hook({*settings_.notify.hook, message.json, message.kind, message.subject,
                   milliseconds(within_s)});
}

void Working::deliver() {
  const Outbox::Message* message = outbox_.due(now_s());
  if (message == nullptr) return;
  const auto sent = send(*message, settings_.notify.hook_timeout_s);
  if (sent) return outbox_.delivered();
  const std::string subject = message->subject;
  const bool again = outbox_.failed(now_s());
  spdlog::warn("message not delivered ({}): {}; {}", subject, to_text(sent.error()),
               again ? "it is tried again" : "given up");
}

void Working::last_try() {
  const double until_s = now_s() + last_try_s;
  constexpr double always_due = std::numeric_limits<double>::infinity();
  while (const Outbox::Message* message = outbox_.due(always_due)) {
    const double left_s = std::min(until_s - now_s(), settings_.notify.hook_timeout_s);
    const auto sent = left_s > 0 ? send(*message, left_s) : fail(Errc::timeout, "the daemon ends");
    if (!sent) {
      spdlog::warn("message not delivered ({}): {}; the daemon ends", message->subject,
                   to_text(sent.error()));
    }
    outbox_.delivered();
  }
}

void Working::beat(const status::View& view) {
  if (!settings_.notify.heartbeat || now_s() < next_beat_s_) return;
  if (!view.now || view.silent_s > alive_within_s) return;
  next_beat_s_ = now_s() + settings_.notify.heartbeat_interval_s;
  const auto beaten = run_hook({*settings_.notify.heartbeat, status::status_json(view) + "\n",
                                "heartbeat", view.facts.campaign + ": " + view.now->text,
                                milliseconds(settings_.notify.hook_timeout_s)});
  if (!beaten && !beat_failed_) spdlog::warn("heartbeat: {}; it goes on", to_text(beaten.error()));
  if (beaten && beat_failed_) spdlog::info("the heartbeat is heard again");
  beat_failed_ = !beaten;
}

void Working::feed(const status::View& view) {
  if (!broker_ || !view.now || now_s() < next_feed_s_) return;
  next_feed_s_ = now_s() + settings_.mqtt->interval_s;
  broker_->status(status::status_json(view));
}

}  // namespace

std::unique_ptr<Notifier> Notifier::start(const DaemonSettings& settings, status::Facts facts) {
  const bool asked = settings.notify.hook || settings.notify.heartbeat || settings.mqtt;
  if (!asked) return nullptr;
  return std::make_unique<Working>(settings, std::move(facts));
}

}  // namespace gyrocal::notify
