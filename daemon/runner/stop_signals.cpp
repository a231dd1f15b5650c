#include "daemon/runner/stop_signals.h"

#include <array>
#include <csignal>

namespace gyrocal::runner {
namespace {

constexpr std::array stopping{SIGTERM, SIGINT, SIGHUP};
volatile std::sig_atomic_t stop_asked = 0;
std::array<struct sigaction, stopping.size()> before{};

extern "C" void ask_to_stop(int signal) {
  stop_asked = 1;
  if (signal == SIGINT) std::signal(SIGINT, SIG_DFL);
}

}  // namespace

StopSignals::StopSignals() {
  stop_asked = 0;
  for (std::size_t i = 0; i < stopping.size(); ++i) {
    struct sigaction action {};
    action.sa_handler = ask_to_stop;
    sigaction(stopping[i], &action, &before[i]);
  }
}

StopSignals::~StopSignals() {
  for (std::size_t i = 0; i < stopping.size(); ++i) sigaction(stopping[i], &before[i], nullptr);
}

bool StopSignals::asked() { return stop_asked != 0; }

}  // namespace gyrocal::runner
