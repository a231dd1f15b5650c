#include "tests/hidden_effects/run_program.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstring>
#include <fstream>
#include <iterator>
#include <thread>

extern char** environ;

namespace hidden {
namespace {

using Seconds = std::chrono::duration<double>;
using SteadyClock = std::chrono::steady_clock;

/// Polls: waitpid has no timeout, and two hundredths against seconds of work are nothing.
int wait_at_most(pid_t child, double limit_s, bool& stopped) {
  const auto start = SteadyClock::now();
  int status = 0;
  while (waitpid(child, &status, WNOHANG) == 0) {
    if (Seconds(SteadyClock::now() - start).count() > limit_s) {
      stopped = true;
      kill(child, SIGKILL);
      waitpid(child, &status, 0);
      break;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  return status;
}

std::string how_it_ended(int status, bool stopped, double limit_s) {
  if (stopped) return "stopped after " + std::to_string(limit_s) + " s";
  if (WIFSIGNALED(status)) return std::string("died of ") + strsignal(WTERMSIG(status));
  if (WEXITSTATUS(status) != 0) return "exit code " + std::to_string(WEXITSTATUS(status));
  return "";
}

}  // namespace

std::string read_file(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

Ran run_program(const std::vector<std::string>& words, const std::filesystem::path& output_file,
                double limit_s) {
  std::vector<std::string> owned = words;
  std::vector<char*> arguments;
  for (auto& word : owned) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  const std::string errors_file = output_file.string() + ".err";
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, output_file.c_str(),
                                   O_WRONLY | O_CREAT | O_TRUNC, 0644);
  posix_spawn_file_actions_addopen(&files, STDERR_FILENO, errors_file.c_str(),
                                   O_WRONLY | O_CREAT | O_TRUNC, 0644);
  const auto start = SteadyClock::now();
  pid_t child = 0;
  const int code = posix_spawn(&child, arguments[0], &files, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&files);
  if (code != 0) return {"cannot start " + owned[0] + ": " + std::strerror(code), "", 0.0};
  bool stopped = false;
  const int status = wait_at_most(child, limit_s, stopped);
  const double seconds = Seconds(SteadyClock::now() - start).count();
  return {how_it_ended(status, stopped, limit_s), read_file(output_file), seconds};
}

}  // namespace hidden
