#pragma once

#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <catch2/catch.hpp>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>
#include <string>
#include <thread>

#include "drivers/tty_lock.h"

namespace gyrocal::status {

/// The Chromium of this machine, if there is one.
inline std::optional<std::string> chromium() {
  std::istringstream path(std::getenv("PATH") ? std::getenv("PATH") : "");
  for (std::string folder; std::getline(path, folder, ':');) {
    for (const char* name : {"chromium", "chromium-browser", "google-chrome"}) {
      const std::string program = (std::filesystem::path(folder) / name).string();
      if (::access(program.c_str(), X_OK) == 0) return program;
    }
  }
  return std::nullopt;
}

/// One page in a headless Chromium, driven by its DevTools protocol over pipes.
class Browser {
 public:
  Browser(const std::string& program, const std::string& profile) {
    std::array<int, 2> to{};
    std::array<int, 2> from{};
    REQUIRE(::pipe(to.data()) == 0);
    REQUIRE(::pipe(from.data()) == 0);
    pid_ = ::fork();
    if (pid_ == 0) exec(program, profile, to[0], from[1]);
    ::close(to[0]);
    ::close(from[1]);
    to_ = UniqueFd(to[1]);
    from_ = UniqueFd(from[0]);
    const auto target = call("Target.createTarget", {{"url", "about:blank"}})["targetId"];
    session_ =
        call("Target.attachToTarget", {{"targetId", target}, {"flatten", true}})["sessionId"];
    call("Runtime.enable");
  }
  ~Browser() {
    ::kill(-pid_, SIGKILL);
    ::waitpid(pid_, nullptr, 0);
  }
  Browser(const Browser&) = delete;
  Browser& operator=(const Browser&) = delete;

  void open(const std::string& url) { call("Page.navigate", {{"url", url}}); }
  void phone() {
    call("Emulation.setDeviceMetricsOverride",
         {{"width", 390}, {"height", 844}, {"deviceScaleFactor", 2}, {"mobile", true}});
  }
  /// The value of a JavaScript expression.
  nlohmann::json value(const std::string& expression) {
    return call("Runtime.evaluate", {{"expression", expression}, {"returnByValue", true}})["result"]
        .value("value", nlohmann::json());
  }
  /// Asks until the expression is true; gives up after a minute.
  bool becomes(const std::string& expression) {
    const auto until = std::chrono::steady_clock::now() + std::chrono::seconds{60};
    while (std::chrono::steady_clock::now() < until) {
      if (value(expression) == true) return true;
      std::this_thread::sleep_for(std::chrono::milliseconds{100});
    }
    return false;
  }
  /// What scripts have thrown and nobody caught.
  [[nodiscard]] const std::string& exceptions() const { return exceptions_; }

 private:
  [[noreturn]] static void exec(const std::string& program, const std::string& profile, int in,
                                int out) {
    ::setpgid(0, 0);
    const int commands = ::fcntl(in, F_DUPFD, 100);
    const int answers = ::fcntl(out, F_DUPFD, 100);
    ::dup2(commands, 3);
    ::dup2(answers, 4);
    const int nowhere = ::open("/dev/null", O_WRONLY);
    ::dup2(nowhere, STDERR_FILENO);
    const std::string folder = "--user-data-dir=" + profile;
    ::execl(program.c_str(), program.c_str(), "--headless=new", "--no-sandbox", "--disable-gpu",
            "--remote-debugging-pipe", folder.c_str(), nullptr);
    ::_exit(127);
  }
  nlohmann::json call(const std::string& method, const nlohmann::json& parameters = {}) {
    nlohmann::json message{{"id", ++calls_}, {"method", method}};
    if (!parameters.is_null()) message["params"] = parameters;
    if (!session_.empty()) message["sessionId"] = session_;
    const std::string text = message.dump() + '\0';
    REQUIRE(::write(to_.get(), text.data(), text.size()) == static_cast<ssize_t>(text.size()));
    for (;;) {
      const auto answer = next();
      if (answer.value("method", "") == "Runtime.exceptionThrown") exceptions_ += answer.dump();
      if (answer.value("id", 0) == calls_) return answer.value("result", nlohmann::json::object());
    }
  }
  nlohmann::json next() {
    while (heard_.find('\0') == std::string::npos) {
      std::array<char, 65536> bytes{};
      const ssize_t got = ::read(from_.get(), bytes.data(), bytes.size());
      if (got <= 0) FAIL("chromium has ended");
      heard_.append(bytes.data(), static_cast<std::size_t>(got));
    }
    const auto end = heard_.find('\0');
    const auto message = nlohmann::json::parse(heard_.substr(0, end));
    heard_.erase(0, end + 1);
    return message;
  }

  pid_t pid_ = -1;
  UniqueFd to_;
  UniqueFd from_;
  std::string session_;
  int calls_ = 0;
  std::string heard_;
  std::string exceptions_;
};

}  // namespace gyrocal::status
