#include "daemon/runner/control_socket.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <system_error>

#include "daemon/runner/run_recording.h"

namespace gyrocal::runner {
namespace {

constexpr std::size_t line_max = 64;
constexpr std::size_t clients_max = 8;
constexpr mode_t owner_and_group = 0660;
constexpr timeval patience{10, 0};
constexpr char unit_folder[] = "/run/gyrocal";

Result<sockaddr_un> address_of(const std::string& path) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  if (path.size() >= sizeof address.sun_path) {
    return fail(Errc::storage, path + ": too long a path for a socket",
                "set XDG_RUNTIME_DIR to a shorter one");
  }
  std::memcpy(address.sun_path, path.data(), path.size());
  return address;
}

const sockaddr* raw(const sockaddr_un& address) {
  return reinterpret_cast<const sockaddr*>(&address);
}

std::string reason() { return std::generic_category().message(errno); }

void answer(const UniqueFd& socket, const std::string& text) {
  const std::string line = text + "\n";  // fits any socket's buffer; a client that has gone is gone
  static_cast<void>(::send(socket.get(), line.data(), line.size(), MSG_NOSIGNAL | MSG_DONTWAIT));
}

bool answers(const sockaddr_un& address) {
  const UniqueFd probe(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0));
  return ::connect(probe.get(), raw(address), sizeof address) == 0;
}

}  // namespace

std::string runtime_folder() {
  if (const char* unit = std::getenv("RUNTIME_DIRECTORY")) return unit;
  if (const char* session = std::getenv("XDG_RUNTIME_DIR"))
    return std::string(session) + "/gyrocal";
  if (::getuid() == 0) return unit_folder;
  return fmt::format("/tmp/gyrocal-{}", ::getuid());
}

std::string control_path(const std::string& campaign_name) {
  return runtime_folder() + "/" + campaign_name + ".sock";
}

std::vector<std::string> folders_of_running_campaigns() {
  std::vector<std::string> folders{runtime_folder()};
  if (folders.front() != unit_folder) folders.push_back(unit_folder);
  return folders;
}

ControlSocket::ControlSocket(UniqueFd listener, std::string path)
    : listener_(std::move(listener)), path_(std::move(path)) {}

ControlSocket::~ControlSocket() {
  if (listener_.is_open()) ::unlink(path_.c_str());
}

Result<ControlSocket> ControlSocket::open(const std::string& path) {
  auto address = address_of(path);
  if (!address) return tl::unexpected(address.error());
  std::error_code folder;
  std::filesystem::create_directories(std::filesystem::path(path).parent_path(), folder);
  if (answers(*address)) {
    return fail(Errc::busy, path + ": a campaign of that name runs already", "gyrocal status");
  }
  ::unlink(path.c_str());
  UniqueFd listener(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
  if (::bind(listener.get(), raw(*address), sizeof *address) != 0 ||
      ::chmod(path.c_str(), owner_and_group) != 0 || ::listen(listener.get(), clients_max) != 0) {
    return fail(Errc::storage, fmt::format("make control socket {}: {}", path, reason()),
                "set XDG_RUNTIME_DIR to a folder of yours");
  }
  return ControlSocket(std::move(listener), path);
}

void ControlSocket::accept_clients() {
  while (clients_.size() < clients_max) {
    UniqueFd socket(::accept4(listener_.get(), nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK));
    if (!socket.is_open()) return;
    clients_.push_back({std::move(socket)});
  }
}

void ControlSocket::read_line(Client& client) {
  std::array<char, line_max> bytes{};
  const ssize_t got = ::recv(client.socket.get(), bytes.data(), bytes.size(), 0);
  if (got < 0 && (errno == EAGAIN || errno == EINTR)) return;
  if (got > 0) client.input.append(bytes.data(), static_cast<std::size_t>(got));
  const auto end = client.input.find('\n');
  if (end != std::string::npos) return obey(client, client.input.substr(0, end));
  client.done = got <= 0 || client.input.size() > line_max;
}

void ControlSocket::obey(Client& client, const std::string& line) {
  if (line == "status") {
    answer(client.socket, snapshot_json(before_));
    client.done = true;
  } else if (auto command = command_named(line)) {
    commands_.push_back(*command);
    client.awaits_outcome = true;
  } else {
    answer(client.socket, nlohmann::json{{"ok", false}, {"why", "unknown command"}}.dump());
    client.done = true;
  }
}

std::optional<campaign::Event> ControlSocket::next_command() {
  accept_clients();
  for (auto& client : clients_) {
    if (!client.awaits_outcome) read_line(client);
  }
  if (commands_.empty()) return std::nullopt;
  const campaign::Event command = commands_.front();
  commands_.pop_front();
  return command;
}

void ControlSocket::serve(const Snapshot& now) {
  for (auto& client : clients_) {
    if (!client.awaits_outcome) continue;
    const bool changed = now.text != before_.text;
    nlohmann::json outcome{{"ok", changed}, {"state", now.state}, {"text", now.text}};
    if (!changed) outcome["why"] = "not possible while " + now.text;
    answer(client.socket, outcome.dump());
    client.done = true;
  }
  std::erase_if(clients_, [](const Client& client) { return client.done; });
  before_ = now;
}

std::string snapshot_json(const Snapshot& now) {
  nlohmann::ordered_json json{{"state", now.state},
                              {"text", now.text},
                              {"t_s", to_seconds(now.t)},
                              {"since_s", to_seconds(now.t - now.since)},
                              {"left_s", to_seconds(now.left)},
                              {"left_s_max", to_seconds(now.left_max)},
                              {"setpoints", now.setpoints},
                              {"setpoints_done", now.setpoints_done},
                              {"boards", now.boards},
                              {"boards_present", now.boards_present},
                              {"chamber_age_s", to_seconds(now.chamber_age)}};
  if (now.air) json["chamber_c"] = now.air->value;
  if (now.setpoint) json["setpoint_c"] = now.setpoint->value;
  if (now.dwell_share) json["dwell_share"] = *now.dwell_share;
  return json.dump();
}

Result<std::string> ask_campaign(const std::string& path, const std::string& command) {
  auto address = address_of(path);
  if (!address) return tl::unexpected(address.error());
  const UniqueFd socket(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0));
  if (::connect(socket.get(), raw(*address), sizeof *address) != 0) {
    return fail(Errc::link_lost, fmt::format("{}: no campaign answers there: {}", path, reason()),
                "is it running, and as a user whose sockets you may write to?");
  }
  ::setsockopt(socket.get(), SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
  answer(socket, command);
  std::string line;
  std::array<char, 512> bytes{};
  while (line.find('\n') == std::string::npos) {
    const ssize_t got = ::recv(socket.get(), bytes.data(), bytes.size(), 0);
    if (got <= 0) {
      return fail(Errc::timeout, path + ": the campaign did not answer",
                  "it may be waiting for a device; ask again");
    }
    line.append(bytes.data(), static_cast<std::size_t>(got));
  }
  line.resize(line.find('\n'));
  return line;
}

}  // namespace gyrocal::runner
