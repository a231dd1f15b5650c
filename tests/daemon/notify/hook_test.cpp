#include "daemon/notify/hook.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <signal.h>
#include <sys/stat.h>

#include <catch2/catch.hpp>
#include <fstream>
#include <sstream>
#include <thread>

#include "daemon/notify/notifier.h"
#include "drivers/tty_lock.h"
#include "tests/daemon/runner/temporary_folder.h"
#include "tests/daemon/status/sample_view.h"

namespace gyrocal::notify {
namespace {

using runner::TemporaryFolder;
using namespace std::chrono_literals;

std::string script(const TemporaryFolder& folder, const std::string& name,
                   const std::string& lines) {
  const std::string path = folder.write(name, fmt::format("#!/bin/sh\n{}", lines));
  REQUIRE(::chmod(path.c_str(), 0755) == 0);
  return path;
}

std::string text_of(const std::string& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

Result<void> run(const std::string& program, const std::string& input = "{}",
                 std::chrono::milliseconds within = 30s) {
  return run_hook({program, input, "trip", "weekend: trip", within});
}

}  // namespace

SCENARIO("a hook reads the facts, and finds kind and subject in its environment") {
  const TemporaryFolder folder;
  const std::string out = folder / "out";
  const std::string input(300000, 'x');  // more than a pipe holds
  REQUIRE(run(script(folder, "hook",
                     "cat > " + out + "\necho \"$GYROCAL_KIND/$GYROCAL_SUBJECT\" >> " + out + "\n"),
              input));
  CHECK(text_of(out) == input + "trip/weekend: trip\n");
}

SCENARIO("a hook that fails is an error with its exit code and last words") {
  const TemporaryFolder folder;
  const auto failed = run(script(folder, "hook", "echo no route to host >&2\nexit 7\n"));
  REQUIRE_FALSE(failed);
  CHECK(failed.error().code == Errc::refused);
  CHECK(failed.error().what.find("exit code 7") != std::string::npos);
  CHECK(failed.error().advice.find("no route to host") != std::string::npos);
}

SCENARIO("a hook that hangs is killed with what it started") {
  const TemporaryFolder folder;
  const std::string pid = folder / "pid";
  const auto failed =
      run(script(folder, "hook", "sleep 1000 &\necho $! > " + pid + "\nwait\n"), "{}", 500ms);
  REQUIRE_FALSE(failed);
  CHECK(failed.error().code == Errc::timeout);
  const int child = std::stoi(text_of(pid));
  REQUIRE(child > 1);
  const std::string stat = fmt::format("/proc/{}/stat", child);
  const auto sleeps = [&] { return text_of(stat).find(" S ") != std::string::npos; };
  for (int i = 0; i < 200 && sleeps(); ++i) std::this_thread::sleep_for(10ms);
  CHECK_FALSE(sleeps());
}

SCENARIO("a hook that is not there, is no program, or does not read, is no harm") {
  const TemporaryFolder folder;
  CHECK(run(folder / "missing").error().code == Errc::storage);
  CHECK(run(folder.write("plain", "no program")).error().code == Errc::storage);
  CHECK(run("/bin/true", std::string(1000000, 'x')));
  CHECK(run(script(folder, "closes", "exec 0<&-\nexec 1>&-\nexec 2>&-\nsleep 0.1\n"),
            std::string(1000000, 'x')));
}

SCENARIO("a hook inherits nothing of the daemon's") {
  const TemporaryFolder folder;
  const UniqueFd device(::open("/dev/null", O_RDONLY));  // without O_CLOEXEC
  REQUIRE(device.is_open());
  const std::string out = folder / "out";
  ::setenv("NOTIFY_SOCKET", "/run/systemd/notify", 1);
  const auto ignored = ::signal(SIGPIPE, SIG_IGN);
  REQUIRE(run(script(folder, "hook",
                     "ls /proc/$$/fd | sort -n | tail -1 > " + out +
                         "\ngrep SigIgn /proc/$$/status >> " + out +
                         "\necho \"[$NOTIFY_SOCKET]\" >> " + out + "\n")));
  ::signal(SIGPIPE, ignored);
  ::unsetenv("NOTIFY_SOCKET");
  const std::string text = text_of(out);
  INFO(text);
  const auto ignored_there = text.find("SigIgn:\t");
  REQUIRE(ignored_there != std::string::npos);
  CHECK((std::stoull(text.substr(ignored_there + 8), nullptr, 16) >> (SIGPIPE - 1) & 1) == 0);
  CHECK(text.find("[]") != std::string::npos);
  // The shell itself reads its script at a descriptor of its own, 10 or above.
  CHECK(std::stoi(text) != device.get());
}

SCENARIO("a campaign's end reaches the hook, though another one hangs first") {
  const TemporaryFolder folder;
  const std::string out = folder / "out";
  DaemonSettings settings;
  settings.notify.hook = script(
      folder, "hook", "case $GYROCAL_KIND in outage) sleep 1000;; esac\ncat >> " + out + "\n");
  settings.notify.outage_s = 0;
  settings.notify.hook_timeout_s = 0.3;
  settings.notify.heartbeat = script(folder, "beat", "cat > " + (folder / "beat.json") + "\n");
  auto notifier = Notifier::start(settings, status::sample_facts());
  REQUIRE(notifier);
  auto now = status::sample_snapshot();
  now.each_board[0].present = false;
  notifier->mailbox().put(now);
  for (int i = 0; i < 600 && text_of(folder / "beat.json").empty(); ++i) {
    std::this_thread::sleep_for(50ms);
  }
  CHECK(text_of(folder / "beat.json").find("gyrocal-status/1") != std::string::npos);
  now.state = "finished";
  notifier->mailbox().put(now);
  notifier.reset();
  CHECK(text_of(out).find("\"kind\":\"ended\"") != std::string::npos);
}

SCENARIO("nobody to tell needs no thread") {
  CHECK(Notifier::start({}, status::sample_facts()) == nullptr);
}

}  // namespace gyrocal::notify
