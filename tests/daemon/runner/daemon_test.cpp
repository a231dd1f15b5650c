// gyrocald as systemd would run it: killed at random instants, stopped, told about, told to.
#include <fmt/core.h>
#include <poll.h>
#include <signal.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <chrono>
#include <cstring>
#include <random>

#include "daemon/runner/owned_devices.h"
#include "schema/store.h"
#include "tests/daemon/runner/served_rig.h"

namespace gyrocal::runner {
namespace {

/// One run of the daemon as a child process.
class Daemon {
 public:
  Daemon(const std::string& campaign, const std::string& database, const std::string& notify = {}) {
    pid_ = ::fork();
    if (pid_ != 0) return;
    if (!notify.empty()) ::setenv("NOTIFY_SOCKET", notify.c_str(), 1);
    const std::string log = database + ".log";
    static_cast<void>(::freopen(log.c_str(), "a", stderr));
    ::execl(GYROCALD_PROGRAM, "gyrocald", campaign.c_str(), "--db", database.c_str(), nullptr);
    ::_exit(127);
  }
  ~Daemon() {
    if (pid_ <= 0) return;
    ::kill(pid_, SIGKILL);
    wait();
  }
  Daemon(const Daemon&) = delete;
  Daemon& operator=(const Daemon&) = delete;

  void signal(int number) const { ::kill(pid_, number); }
  /// The exit code; -1 if a signal ended it.
  int wait() {
    int status = 0;
    ::waitpid(std::exchange(pid_, -1), &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

 private:
  pid_t pid_;
};

/// What a unit's NOTIFY_SOCKET hears.
class NotifySocket {
 public:
  explicit NotifySocket(const std::string& path) : fd_(::socket(AF_UNIX, SOCK_DGRAM, 0)) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    std::memcpy(address.sun_path, path.data(), path.size());
    REQUIRE(::bind(fd_, reinterpret_cast<sockaddr*>(&address), sizeof address) == 0);
  }
  ~NotifySocket() { ::close(fd_); }
  NotifySocket(const NotifySocket&) = delete;
  NotifySocket& operator=(const NotifySocket&) = delete;

  /// Waits until a message with `part` has come; gives up after 30 s.
  bool hears(const std::string& part) {
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds{30};
    while (heard_.find(part) == std::string::npos) {
      pollfd waiting{fd_, POLLIN, 0};
      if (std::chrono::steady_clock::now() > deadline) return false;
      if (::poll(&waiting, 1, 1000) <= 0) continue;
      char bytes[512];
      const ssize_t got = ::recv(fd_, bytes, sizeof bytes, 0);
      if (got > 0) heard_.append(bytes, static_cast<std::size_t>(got)).append("\n");
    }
    return true;
  }

 private:
  int fd_;
  std::string heard_;
};

std::size_t accepted(const std::string& database) {
  const auto store = Store::open_read_only(database);
  if (!store) FAIL(to_text(store.error()));
  const auto campaign = *store->latest_campaign();
  if (!campaign) return 0;
  std::size_t count = 0;
  const auto boards = store->boards(*campaign);
  for (const auto& [id, board] : *boards) {
    const auto dwells = *store->accepted_dwells(*campaign, id);
    for (const auto& dwell : dwells) CHECK(store->samples(dwell.id)->size() == 200);
    count += dwells.size();
  }
  return count;
}

}  // namespace

SCENARIO("killed at random instants, gyrocald goes on: no dwell lost, none twice") {
  const TemporaryFolder folder;
  const ServedRig rig(folder);
  const std::string campaign = folder.write("wired.toml", campaign_text(folder, rig.port()));
  const std::string database = folder / "wired.db";
  const unsigned seed = 20261124;
  CAPTURE(seed);
  std::mt19937 random(seed);
  std::size_t before = 0;
  for (int kill = 0; kill < 6; ++kill) {
    Daemon daemon(campaign, database);
    ::usleep(200'000 +
             static_cast<useconds_t>(random() % 1'800'000));  // the instant is what is random here
    daemon.signal(SIGKILL);
    static_cast<void>(daemon.wait());
    if (!std::filesystem::exists(database)) continue;
    const std::size_t now = accepted(database);
    CHECK(now >= before);
    before = now;
  }
  Daemon last(campaign, database);
  CHECK(last.wait() == 0);
  CHECK(accepted(database) == 6);
  Daemon again(campaign, database);
  CHECK(again.wait() == 0);  // it has ended: left alone
  CHECK(accepted(database) == 6);
}

SCENARIO(
    "systemd hears READY, STATUS and WATCHDOG; SIGTERM leaves a safe chamber, within its time") {
  const TemporaryFolder folder;
  const ServedRig rig(folder);
  const std::string campaign = folder.write("wired.toml", campaign_text(folder, rig.port()));
  NotifySocket unit(folder / "notify");
  Daemon daemon(campaign, folder / "wired.db", folder / "notify");
  CHECK(unit.hears("READY=1"));
  CHECK(unit.hears("STATUS=ramping"));
  CHECK(unit.hears("WATCHDOG=1"));
  daemon.signal(SIGTERM);
  CHECK(unit.hears("EXTEND_TIMEOUT_USEC="));
  CHECK(daemon.wait() == 3);

  const auto config = parse_campaign(campaign_text(folder, rig.port()), folder / "c.toml");
  REQUIRE(config);
  const auto owned = wired_devices(*config);
  CHECK(owned->devices().chamber.read()->setpoint == Celsius{25});
}

}  // namespace gyrocal::runner
