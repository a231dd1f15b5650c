#include "tests/bench/child_process.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <filesystem>
#include <fstream>

#include "tests/bench/measure.h"

namespace gyrocal::bench {
namespace {

double seconds_of(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

std::string read_all(int from) {
  std::string text;
  std::array<char, 4096> block;
  for (ssize_t got = 0; (got = read(from, block.data(), block.size())) > 0;) {
    text.append(block.data(), static_cast<std::size_t>(got));
  }
  return text;
}

/// Linux counts this process's own peak into a child's until it has its own memory: forget it, so
/// that a child's peak is at least what is resident here now and no more.
void forget_own_peak() { std::ofstream("/proc/self/clear_refs") << "5"; }

struct Started {
  pid_t child = -1;
  int out = -1;  ///< the end to read its standard output from
};

std::optional<Started> start(const std::vector<std::string>& arguments) {
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0) return std::nullopt;
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  std::vector<char*> argv;
  for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);
  forget_own_peak();
  Started started{-1, ends[0]};
  const int failed = posix_spawnp(&started.child, argv[0], &actions, nullptr, argv.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  close(ends[1]);
  if (failed == 0) return started;
  close(ends[0]);
  return std::nullopt;
}

}  // namespace

std::optional<ChildResult> run_child(const std::vector<std::string>& arguments) {
  const double begin = wall_now_s();
  const auto started = start(arguments);
  if (!started) return std::nullopt;
  ChildResult result;
  result.printed = read_all(started->out);
  close(started->out);
  int status = 0;
  rusage used{};
  wait4(started->child, &status, 0, &used);
  result.wall_s = wall_now_s() - begin;
  result.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  result.cpu_s = seconds_of(used.ru_utime) + seconds_of(used.ru_stime);
  result.memory_bytes = 1024.0 * static_cast<double>(used.ru_maxrss);
  return result;
}

std::string this_program() { return std::filesystem::read_symlink("/proc/self/exe").string(); }

BackgroundProcess::BackgroundProcess(const std::vector<std::string>& arguments) {
  const auto started = start(arguments);
  if (!started) return;
  child_ = started->child;
  out_ = started->out;
}

BackgroundProcess::~BackgroundProcess() {
  if (child_ < 0) return;
  kill(child_, SIGTERM);
  waitpid(child_, nullptr, 0);
  close(out_);
}

std::string BackgroundProcess::read_line() {
  std::string line;
  for (char c = 0; out_ >= 0 && read(out_, &c, 1) == 1 && c != '\n';) line += c;
  return line;
}

}  // namespace gyrocal::bench
