#include "drivers/simulated/rig_server.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <set>

#include "compensation/values/assert.h"

namespace gyrocal {
namespace {

namespace fs = std::filesystem;
constexpr std::chrono::milliseconds turn_min{1};  // frames of one turn leave in one write
constexpr std::chrono::milliseconds turn_max{1000};

}  // namespace

Result<RigServer::Folder> RigServer::Folder::open(const std::string& path) {
  std::error_code error;
  const bool made = fs::create_directories(path, error);
  UniqueFd lock(::open(path.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (!lock.is_open()) {
    const int code = errno;
    return fail(Errc::storage, fmt::format("link directory {}: {}", path, std::strerror(code)),
                "choose a directory that can be made and written to");
  }
  if (::flock(lock.get(), LOCK_EX | LOCK_NB) != 0) {
    return fail(Errc::busy, fmt::format("link directory {}: another rig serves there", path),
                "end it, or choose another directory");
  }
  return Folder(std::move(lock), made ? path : std::string{});
}

RigServer::Folder::~Folder() {
  std::error_code not_empty;
  if (lock_.is_open() && !made_.empty()) fs::remove(made_, not_empty);
}

RigServer::RigServer(SimulatedRig& rig, Clock& clock, double time_scale, ModbusTcpServer chamber)
    : rig_(rig), clock_(clock), time_scale_(time_scale), chamber_(std::move(chamber)) {}

Result<RigServer> RigServer::open(SimulatedRig& rig, Clock& clock, const RigEndpoints& endpoints,
                                  double time_scale) {
  GYROCAL_ASSERT(endpoints.links.size() == rig.board_count());
  auto chamber = ModbusTcpServer::open(endpoints.host, endpoints.port);
  if (!chamber) return tl::unexpected(chamber.error());
  RigServer server(rig, clock, time_scale, *std::move(chamber));
  if (const auto opened = server.open_boards(endpoints.links); !opened) {
    return tl::unexpected(opened.error());
  }
  return server;
}

Result<void> RigServer::open_boards(const std::vector<std::string>& links) {
  std::set<std::string> folders;
  for (const std::string& link : links) folders.insert(fs::absolute(link).parent_path().string());
  for (const std::string& path : folders) {
    auto folder = Folder::open(path);
    if (!folder) return tl::unexpected(folder.error());
    folders_.push_back(*std::move(folder));
  }
  boards_.reserve(links.size());
  for (std::size_t index = 0; index < links.size(); ++index) {
    auto pty = BoardPty::open(rig_.board(index), fs::absolute(links[index]).string(), clock_.now());
    if (!pty) return tl::unexpected(pty.error());
    boards_.push_back(*std::move(pty));
  }
  return {};
}

std::chrono::milliseconds RigServer::time_to_next_event() const {
  const auto rounded_up = [](Duration wait) {
    return std::clamp(std::chrono::ceil<std::chrono::milliseconds>(wait), turn_min, turn_max);
  };
  auto wait = turn_max;
  const auto await = [&](std::optional<Instant> event) {
    if (!event) return;
    const double ours_ns = static_cast<double>((*event - clock_.now()).count()) / time_scale_;
    wait = std::min(wait, rounded_up(Duration{std::llround(ours_ns)}));
  };
  await(rig_.next_fault());
  for (std::size_t index = 0; index < rig_.board_count(); ++index) {
    await(rig_.board(index).next_event());
  }
  if (const auto deadline = chamber_.deadline()) {
    wait = std::min(wait, rounded_up(*deadline - std::chrono::steady_clock::now()));
  }
  return wait;
}

Result<void> RigServer::turn(std::chrono::milliseconds wait, int stop) {
  watched_.assign(1, {stop, POLLIN, 0});
  chamber_.watch(watched_);
  for (const BoardPty& board : boards_) board.watch(watched_);
  ::poll(watched_.data(), watched_.size(), static_cast<int>(wait.count()));
  const Instant now = clock_.now();
  rig_.reach(now);
  chamber_.set_refusing(rig_.chamber().refuses());
  chamber_.serve(std::chrono::steady_clock::now(), [&](std::span<const std::uint8_t> request) {
    return rig_.chamber().exchange(request, now);
  });
  for (BoardPty& board : boards_) {
    if (auto served = board.serve(now); !served) return served;
  }
  return {};
}

Result<void> RigServer::run(int stop) {
  for (;;) {
    pollfd asked{stop, POLLIN, 0};
    if (::poll(&asked, 1, 0) != 0) return {};
    if (auto served = turn(time_to_next_event(), stop); !served) return served;
  }
}

}  // namespace gyrocal
