#include "daemon/notify/hook.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "drivers/tty_lock.h"  // UniqueFd

namespace gyrocal::notify {
namespace {

using SteadyClock = std::chrono::steady_clock;
using Deadline = SteadyClock::time_point;

constexpr std::size_t output_kept = 400;
constexpr std::chrono::milliseconds look_again_after{20};

std::string reason(int code) { return std::generic_category().message(code); }

/// One end for the hook's standard streams, the other ours. A socket pair: writing to one whose
/// reader has gone is an error and not a signal.
Result<std::pair<UniqueFd, UniqueFd>> stream_pair() {
  std::array<int, 2> ends{-1, -1};
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) {
    return fail(Errc::storage, "make the hook's standard streams: " + reason(errno));
  }
  return std::pair(UniqueFd(ends[0]), UniqueFd(ends[1]));
}

std::vector<std::string> environment_of(const HookCall& call) {
  std::vector<std::string> variables;
  for (char** entry = environ; *entry != nullptr; ++entry) {
    const std::string_view variable(*entry);
    const bool ours = variable.starts_with("GYROCAL_KIND=") ||
                      variable.starts_with("GYROCAL_SUBJECT=") ||
                      variable.starts_with("NOTIFY_SOCKET=") || variable.starts_with("WATCHDOG_");
    if (!ours) variables.emplace_back(variable);
  }
  variables.push_back("GYROCAL_KIND=" + call.kind);
  variables.push_back("GYROCAL_SUBJECT=" + call.subject);
  return variables;
}

/// The settings of posix_spawn, owned.
class Spawning {
 public:
  explicit Spawning(int standard_streams) {
    posix_spawn_file_actions_init(&actions_);
    for (const int standard : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
      posix_spawn_file_actions_adddup2(&actions_, standard_streams, standard);
    }
    posix_spawn_file_actions_addclosefrom_np(&actions_, STDERR_FILENO + 1);
    posix_spawnattr_init(&attributes_);
    sigset_t every;
    sigset_t none;
    sigfillset(&every);
    sigemptyset(&none);
    posix_spawnattr_setsigdefault(&attributes_, &every);
    posix_spawnattr_setsigmask(&attributes_, &none);
    posix_spawnattr_setpgroup(&attributes_, 0);
    posix_spawnattr_setflags(
        &attributes_, POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETPGROUP);
  }
  ~Spawning() {
    posix_spawn_file_actions_destroy(&actions_);
    posix_spawnattr_destroy(&attributes_);
  }
  Spawning(const Spawning&) = delete;
  Spawning& operator=(const Spawning&) = delete;

  [[nodiscard]] Result<pid_t> start(const HookCall& call) const {
    auto variables = environment_of(call);
    std::vector<char*> raw;
    for (auto& variable : variables) raw.push_back(variable.data());
    raw.push_back(nullptr);
    std::string name = call.program;
    std::array<char*, 2> arguments{name.data(), nullptr};
    pid_t child = 0;
    const int code = ::posix_spawn(&child, call.program.c_str(), &actions_, &attributes_,
                                   arguments.data(), raw.data());
    if (code != 0) {
      return fail(Errc::storage, fmt::format("start {}: {}", call.program, reason(code)),
                  "is it there, executable, and with a #! line?");
    }
    return child;
  }

 private:
  posix_spawn_file_actions_t actions_{};
  posix_spawnattr_t attributes_{};
};

/// Talks with a running hook: its input goes in as it takes it, the end of its output is kept.
class Conversation {
 public:
  Conversation(UniqueFd ours, const std::string& input) : ours_(std::move(ours)), input_(input) {}

  void go_on() {
    const bool more = sent_ < input_.size();
    pollfd watched{ours_.get(), static_cast<short>(more ? POLLIN | POLLOUT : POLLIN), 0};
    if (closed_ || ::poll(&watched, 1, static_cast<int>(look_again_after.count())) <= 0) {
      if (closed_) ::poll(nullptr, 0, static_cast<int>(look_again_after.count()));
      return;
    }
    if (more && (watched.revents & POLLOUT) != 0) send();
    receive();
  }
  void receive() {
    std::array<char, 512> bytes{};
    ssize_t got = 0;
    while ((got = ::recv(ours_.get(), bytes.data(), bytes.size(), MSG_DONTWAIT)) > 0) {
      output_.append(bytes.data(), static_cast<std::size_t>(got));
      if (output_.size() > output_kept) output_.erase(0, output_.size() - output_kept);
    }
    closed_ = got == 0 || (errno != EAGAIN && errno != EINTR);
  }
  [[nodiscard]] const std::string& output() const { return output_; }

 private:
  void send() {
    const ssize_t went = ::send(ours_.get(), input_.data() + sent_, input_.size() - sent_,
                                MSG_DONTWAIT | MSG_NOSIGNAL);
    if (went > 0) sent_ += static_cast<std::size_t>(went);
    // A hook that does not read its input is none the worse for it.
    if (went < 0 && errno != EAGAIN && errno != EINTR) sent_ = input_.size();
    if (sent_ == input_.size()) ::shutdown(ours_.get(), SHUT_WR);
  }

  UniqueFd ours_;
  const std::string& input_;
  std::size_t sent_ = 0;
  bool closed_ = false;
  std::string output_;
};

Result<void> verdict(const HookCall& call, int status, const std::string& output) {
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return {};
  const std::string how = WIFEXITED(status) ? fmt::format("exit code {}", WEXITSTATUS(status))
                                            : fmt::format("ended by signal {}", WTERMSIG(status));
  return fail(Errc::refused, fmt::format("{}: {}", call.program, how),
              output.empty() ? "it wrote nothing" : "it wrote: " + output);
}

}  // namespace

Result<void> run_hook(const HookCall& call) {
  auto streams = stream_pair();
  if (!streams) return tl::unexpected(streams.error());
  const Deadline until = SteadyClock::now() + call.within;
  const auto child = Spawning(streams->second.get()).start(call);
  streams->second = UniqueFd();
  if (!child) return tl::unexpected(child.error());
  Conversation talk(std::move(streams->first), call.input);
  int status = 0;
  while (::waitpid(*child, &status, WNOHANG) == 0) {
    if (SteadyClock::now() >= until) {
      ::kill(-*child, SIGKILL);
      ::waitpid(*child, &status, 0);
      return fail(Errc::timeout,
                  fmt::format("{}: killed after {:.1f} s", call.program,
                              std::chrono::duration<double>(call.within).count()),
                  "does it wait for something? hook_timeout_s in gyrocald.toml");
    }
    talk.go_on();
  }
  talk.receive();
  return verdict(call, status, talk.output());
}

}  // namespace gyrocal::notify
