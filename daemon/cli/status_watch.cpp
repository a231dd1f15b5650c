#include "daemon/cli/status_watch.h"

#include <fmt/core.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <thread>
#include <vector>

#include "daemon/campaign/campaign.h"
#include "daemon/cli/outcome.h"
#include "daemon/runner/control_socket.h"
#include "daemon/runner/progress.h"
#include "daemon/runner/stop_signals.h"

namespace gyrocal::cli {
namespace {

constexpr std::chrono::seconds asked_every{1};
constexpr std::chrono::milliseconds stop_looked_for_every{100};
constexpr int restart_patience = 10;  ///< a daemon that is started again answers within so many

struct Terminal {
  bool is_one = ::isatty(STDOUT_FILENO) != 0;
  bool in_colour = is_one && (std::getenv("NO_COLOR") == nullptr || *std::getenv("NO_COLOR") == 0);

  [[nodiscard]] std::optional<std::size_t> columns() const {
    winsize size{};
    if (!is_one) return std::nullopt;
    if (::ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col == 0) return 80;
    return size.ws_col;
  }
};

const char* colour_of(const std::string& state) {
  if (state == "safe" || state == "aborted") return "\033[31m";
  if (state == "holding" || state == "paused") return "\033[33m";
  return "\033[32m";
}

bool is_status(const nlohmann::json& answer) {
  return answer.is_object() && answer.value("state", nlohmann::json()).is_string() &&
         answer.value("setpoints", nlohmann::json()).is_number();
}

std::string time_of(const nlohmann::json& answer, const char* key) {
  return runner::clock_text(seconds(answer.value(key, 0.0)));
}

/// What the line says, the most important first.
std::vector<std::string> words_of(const nlohmann::json& answer) {
  std::vector<std::string> words;
  words.push_back(
      fmt::format("{}/{}", answer.value("setpoints_done", 0), answer.value("setpoints", 0)));
  if (answer.contains("dwell_share")) {
    words.push_back(fmt::format("dwell {:.0f} %", answer.value("dwell_share", 0.0) * 100));
  }
  std::string air;
  if (answer.contains("chamber_c")) air = fmt::format("{:.1f}", answer.value("chamber_c", 0.0));
  if (answer.contains("setpoint_c")) {
    air += fmt::format("->{:.1f}", answer.value("setpoint_c", 0.0));
  }
  if (!air.empty()) words.push_back(air + " degC");
  words.push_back(time_of(answer, "left_s") + " left");
  const int boards = answer.value("boards", 0);
  const int present = answer.value("boards_present", 0);
  if (present < boards) words.push_back(fmt::format("{} of {} boards", present, boards));
  words.push_back("since " + time_of(answer, "since_s"));
  return words;
}

/// What has to differ for another line where nothing is drawn again.
std::string essence(const std::string& line) {
  const auto answer = nlohmann::json::parse(line, nullptr, false);
  if (!is_status(answer)) return line;
  return fmt::format("{} {} {}", answer.value("text", ""), answer.value("boards_present", 0),
                     int(answer.value("dwell_share", 0.0) * 4));
}

std::string state_of(const std::string& answer) {
  const auto json = nlohmann::json::parse(answer, nullptr, false);
  return is_status(json) ? json.value("state", "") : "";
}

void wait_a_while() {
  const auto until = std::chrono::steady_clock::now() + asked_every;
  while (std::chrono::steady_clock::now() < until && !runner::StopSignals::asked()) {
    std::this_thread::sleep_for(stop_looked_for_every);
  }
}

class Watching {
 public:
  explicit Watching(bool as_json) : as_json_(as_json) {}
  ~Watching() {
    if (drawn_) fmt::print("\n");
  }
  Watching(const Watching&) = delete;
  Watching& operator=(const Watching&) = delete;

  void show(const std::string& answer) {
    const bool draw = terminal_.is_one && !as_json_;
    if (!draw && essence(answer) == shown_) return;
    shown_ = essence(answer);
    const auto line = as_json_ ? answer
                               : status_line(answer, terminal_.columns(), terminal_.in_colour)
                                     .value_or("an answer that is none");
    fmt::print("{}{}{}", draw ? "\r\033[K" : "", line, draw ? "" : "\n");
    drawn_ = draw;
    std::fflush(stdout);
  }

 private:
  bool as_json_;
  Terminal terminal_;
  bool drawn_ = false;
  std::string shown_;
};

}  // namespace

Result<std::string> status_line(const std::string& answer, std::optional<std::size_t> columns,
                                bool in_colour) {
  const auto json = nlohmann::json::parse(answer, nullptr, false);
  if (!is_status(json)) return fail(Errc::bad_input, "no status: " + answer);
  const std::string state = json.value("state", "");
  std::string line = state.substr(0, columns ? *columns - 1 : state.size());
  std::size_t width = line.size();
  if (in_colour) line = colour_of(state) + line + "\033[0m";
  for (const std::string& word : words_of(json)) {
    // The last column stays free: writing there makes some terminals wrap.
    if (columns && width + 2 + word.size() >= *columns) break;
    line += "  " + word;
    width += 2 + word.size();
  }
  return line;
}

bool answer_has_ended(const std::string& answer) { return campaign::has_ended(state_of(answer)); }

int watch_campaign(const std::string& socket, bool as_json) {
  const runner::StopSignals signals;
  Watching watching(as_json);
  Result<std::string> answer;
  bool at_its_end = false;
  for (int failures = 0; failures < restart_patience;) {
    answer = runner::ask_campaign(socket, "status");
    if (runner::StopSignals::asked()) return exit_done;
    if (answer) {
      watching.show(*answer);
      if (answer_has_ended(*answer)) return exit_done;
      at_its_end = state_of(*answer) == "analysing" || state_of(*answer) == "returning";
    } else if (at_its_end) {
      return exit_done;  // between two questions it has ended, and its socket with it
    }
    failures = answer ? 0 : failures + 1;
    wait_a_while();
  }
  return report(answer.error());
}

}  // namespace gyrocal::cli
