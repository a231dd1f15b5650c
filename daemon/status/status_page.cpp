#include "daemon/status/status_page.h"

#include <spdlog/spdlog.h>

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <thread>
#include <utility>

#include "daemon/status/blocked_signals.h"
#include "daemon/status/feed.h"
#include "daemon/status/http_server.h"
#include "daemon/status/past.h"
#include "drivers/clocks.h"

namespace gyrocal::status {
namespace {

constexpr std::chrono::milliseconds gathered_every{100};
constexpr int gathered_per_view = 10;  ///< a view a second: what a page shows

double machine_s(const Clock& clock) { return to_seconds(clock.now().time_since_epoch()); }

class ServedPage final : public StatusPage {
 public:
  explicit ServedPage(Facts facts)
      : facts_(facts),
        live_(std::move(facts)),
        feed_(live_.at(clock_.utc_ns(), machine_s(clock_))) {}
  ~ServedPage() override {
    {
      const std::lock_guard lock(mutex_);
      stopping_ = true;
    }
    wake_.notify_all();
    if (thread_.joinable()) thread_.join();
    gather();
    feed_.publish(live_.at(clock_.utc_ns(), machine_s(clock_)));  // how it ended
    feed_.close();
  }

  [[nodiscard]] Result<void> begin(const StatusSettings& settings) {
    auto server = HttpServer::start(feed_, settings.address, settings.port);
    if (!server) return tl::unexpected(server.error());
    server_ = std::move(*server);
    const BlockedSignals for_new_threads;
    thread_ = std::thread([this] { work(); });
    return {};
  }

  Mailbox& mailbox() override { return mailbox_; }
  void begun(CampaignId campaign, Duration t) override {
    const std::lock_guard lock(mutex_);
    begun_ = {campaign, t};
  }

 private:
  void work();
  void gather();
  void look_back(CampaignId campaign, Duration t);

  ScaledClock clock_;
  Mailbox mailbox_;
  Facts facts_;
  LiveStatus live_;
  Feed feed_;
  std::mutex mutex_;
  std::condition_variable wake_;
  bool stopping_ = false;
  std::optional<std::pair<CampaignId, Duration>> begun_;
  std::thread thread_;
  std::unique_ptr<HttpServer> server_;  // goes first: its threads read the feed
};

void ServedPage::gather() { live_.report(mailbox_.take(), machine_s(clock_)); }

void ServedPage::look_back(CampaignId campaign, Duration t) {
  auto past = read_past(facts_, campaign, t);
  if (past) return live_.remember(std::move(past->events), past->history);
  spdlog::warn("the page begins empty: {}", to_text(past.error()));
}

void ServedPage::work() {
  std::unique_lock lock(mutex_);
  for (int turn = 1; !stopping_; ++turn) {
    const auto begun = std::exchange(begun_, std::nullopt);
    lock.unlock();
    if (begun) look_back(begun->first, begun->second);
    gather();
    if (turn % gathered_per_view == 0) {
      feed_.publish(live_.at(clock_.utc_ns(), machine_s(clock_)));
    }
    lock.lock();
    wake_.wait_for(lock, gathered_every, [this] { return stopping_; });
  }
}

}  // namespace

Result<std::unique_ptr<StatusPage>> StatusPage::start(const StatusSettings& settings, Facts facts) {
  auto serving = std::make_unique<ServedPage>(std::move(facts));
  if (auto begun = serving->begin(settings); !begun) return tl::unexpected(begun.error());
  return serving;
}

}  // namespace gyrocal::status
