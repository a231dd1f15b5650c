#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <fstream>
#include <nlohmann/json.hpp>

#include "drivers/tty_lock.h"
#include "tests/drivers/simulated/bench_board.h"
#include "tests/drivers/simulated/scratch_folder.h"

using namespace gyrocal;

namespace {

/// `gyrocal rig serve ...` as a process, its standard output a pipe.
class Serving {
 public:
  explicit Serving(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {GYROCAL_PROGRAM, "rig", "serve"});
    std::vector<char*> argv;
    for (std::string& argument : arguments) argv.push_back(argument.data());
    argv.push_back(nullptr);
    std::array<int, 2> ends{};
    REQUIRE(::pipe2(ends.data(), O_CLOEXEC) == 0);
    output_ = UniqueFd(ends[0]);
    const UniqueFd theirs(ends[1]);
    process_ = ::fork();
    if (process_ == 0) {
      ::dup2(theirs.get(), STDOUT_FILENO);
      ::execv(argv[0], argv.data());
      ::_exit(127);
    }
    REQUIRE(process_ > 0);
  }
  ~Serving() {
    if (process_ > 0) end(SIGKILL);
  }
  Serving(const Serving&) = delete;
  Serving& operator=(const Serving&) = delete;

  /// Empty once it has ended.
  std::string line() {
    std::string text;
    for (char c = 0; ::read(output_.get(), &c, 1) == 1 && c != '\n';) text += c;
    return text;
  }
  /// Exit code; minus the signal's number if one ended it.
  int end(int signal) {
    if (signal != 0) ::kill(process_, signal);
    int status = 0;
    ::waitpid(process_, &status, 0);
    process_ = -1;
    return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  }

 private:
  UniqueFd output_;
  pid_t process_ = -1;
};

std::string campaign_file(const ScratchFolder& folder, const std::string& chamber,
                          bool simulated = true) {
  std::ofstream file(folder / "campaign.toml");
  file << "[campaign]\nname = \"test\"\nsimulated = " << (simulated ? "true" : "false")
       << "\n[plan]\nsetpoints_c = [20, 30]\n[chamber]\nprofile = \"yinhe\"\nunit = 3\n"
       << chamber << "\n[[board]]\nname = \"left\"\ndevice = \"" << folder / "links/left"
       << "\"\n[[board]]\nname = \"right\"\ndevice = \"" << folder / "links/right"
       << "\"\n";
  return folder / "campaign.toml";
}

}  // namespace

TEST_CASE("rig serve prints its addresses, serves, and ends cleanly on a signal",
          "[simulated][cli]") {
  const int signal = GENERATE(SIGINT, SIGTERM, SIGHUP);
  ScratchFolder folder;
  Serving rig({"--boards", "2", "--port", "0", "--link-dir", folder / "links", "--json"});
  const auto printed = nlohmann::json::parse(rig.line());
  CHECK(printed.at("chamber").at("host") == "127.0.0.1");
  CHECK(printed.at("chamber").at("port") > 0);
  CHECK(printed.at("chamber").at("unit") == 1);
  REQUIRE(printed.at("boards").size() == 2);
  CHECK(printed.at("boards").at(1).at("device") == folder / "links/board1");
  CHECK(printed.at("boards").at(1).at("mcu_id") == "30ffd8054752323751160001");
  const UniqueFd port(::open((folder / "links/board1").c_str(), O_RDWR | O_NOCTTY));
  REQUIRE(port.is_open());
  REQUIRE(::write(port.get(), "\x20\x01\x00", 3) == 3);
  std::array<std::uint8_t, 16> reply{};
  REQUIRE(::read(port.get(), reply.data(), reply.size()) == 3);
  CHECK(hex(std::span(reply).first(3)) == "80 01 00");
  CHECK(rig.end(signal) == 0);
  CHECK(folder.entries() == 0);
}

TEST_CASE("rig serve takes addresses and devices from the campaign", "[simulated][cli]") {
  ScratchFolder folder;
  const auto file = campaign_file(folder, "host = \"127.0.0.1\"\nport = 15999");
  Serving rig({"--campaign", file, "--time-scale", "60"});
  CHECK(rig.line() == "chamber   127.0.0.1:15999  unit 3, Yinhe KHL-SDJ6025F");
  CHECK(rig.line() == "board 0   " + folder / "links/left" + "  MCU 30ffd8054752323751160000");
  CHECK(rig.line() == "board 1   " + folder / "links/right" + "  MCU 30ffd8054752323751160001");
  CHECK(rig.line() ==
        "ready: 60 s of campaign time a second, rig model default, seed 1; Ctrl-C ends it");
  CHECK(rig.end(SIGTERM) == 0);
  CHECK(folder.entries() == 1);  // the campaign file
}

TEST_CASE("rig serve refuses what it cannot be", "[simulated][cli]") {
  ScratchFolder folder;
  const auto refused = [](std::vector<std::string> arguments) {
    Serving rig(std::move(arguments));
    CHECK(rig.line().empty());
    return rig.end(0);
  };
  SECTION("a campaign of real devices") {
    CHECK(refused({"--campaign", campaign_file(folder, "host = \"127.0.0.1\"", false)}) == 2);
  }
  SECTION("a chamber on a serial line") {
    CHECK(refused({"--campaign", campaign_file(folder, "device = \"/dev/ttyS0\"")}) == 2);
  }
  SECTION("no such campaign, no such rig model, a senseless scale, contradicting options") {
    CHECK(refused({"--campaign", folder / "none.toml"}) != 0);
    CHECK(refused({"--port", "0", "--rig-model", folder / "none.json"}) != 0);
    CHECK(refused({"--time-scale", "0"}) == 2);
    CHECK(refused({"--campaign", folder / "campaign.toml", "--boards", "3"}) == 2);
  }
}
