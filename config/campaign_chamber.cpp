#include <arpa/inet.h>
#include <fmt/core.h>
#include <fmt/ranges.h>

#include <array>
#include <filesystem>
#include <iterator>
#include <string_view>
#include <vector>

#include "compensation/values/nearest_name.h"
#include "config/campaign_sections.h"
#include "config/places.h"
#include "config/shipped_names.h"

namespace gyrocal {
namespace {

using namespace std::string_view_literals;
namespace fs = std::filesystem;

bool is_numeric_address(const std::string& host) {
  std::array<unsigned char, sizeof(in6_addr)> address{};
  return inet_pton(AF_INET, host.c_str(), address.data()) == 1 ||
         inet_pton(AF_INET6, host.c_str(), address.data()) == 1;
}

TcpAddress read_tcp(TomlSection& table) {
  TcpAddress address;
  address.host = table.text("host", "");
  if (!is_numeric_address(address.host)) {
    table.expected("host", Errc::bad_input,
                   "a numeric address, 192.0.2.5: no name server is asked");
  }
  address.port = static_cast<int>(table.integer("port", address.port, {1, 65535}));
  return address;
}

RtuAddress read_rtu(TomlSection& table) {
  RtuAddress address;
  address.device = table.required_text("device", "the serial port's stable link");
  address.baud = static_cast<int>(table.integer("baud", address.baud, {300, 1000000, "baud"}));
  constexpr std::array parities{"none"sv, "even"sv, "odd"sv};
  address.parity = "NEO"[table.choice("parity", 0, parities)];
  address.stop_bits = static_cast<int>(table.integer("stop_bits", address.stop_bits, {1, 2}));
  return address;
}

}  // namespace

std::optional<std::string> find_chamber_profile(const std::string& profile,
                                                const std::string& campaign_folder) {
  const fs::path folder(campaign_folder);
  if (profile.find('/') != std::string::npos || profile.ends_with(".toml")) {
    return (folder / profile).lexically_normal().string();
  }
  std::vector<fs::path> folders{folder};
  folders.insert(folders.end(), std::begin(places::chambers), std::end(places::chambers));
  for (const fs::path& place : folders) {
    const fs::path file = place / (profile + ".toml");
    std::error_code ignored;  // an unreadable folder holds no profile for us
    if (fs::is_regular_file(file, ignored)) return file.lexically_normal().string();
  }
  return std::nullopt;
}

namespace {

/// The profile the table names. @return nothing if it names none that is known, which is noted.
Result<std::optional<ChamberProfile>> named_profile(TomlSection& table, const std::string& path) {
  const auto name = table.required_text("profile", "a chamber profile, \"yinhe\"");
  const fs::path folder = fs::path(path).parent_path();
  const auto file = find_chamber_profile(name, folder.string());
  if (name.empty()) return std::nullopt;
  if (!file) {
    const std::vector<std::string> shipped(std::begin(places::chambers),
                                           std::end(places::chambers));
    const auto known = shipped_names(shipped, ".toml");
    const auto near = nearest_name(name, std::vector<std::string_view>(known.begin(), known.end()));
    table.expected("profile", Errc::unknown_name,
                   fmt::format("the name of a profile in {} or {}{}",
                               folder.empty() ? "." : folder.string(), fmt::join(shipped, " or "),
                               near.empty() ? "" : fmt::format("; is \"{}\" meant?", near)));
    return std::nullopt;
  }
  return read_chamber_profile(*file);
}

}  // namespace

std::optional<Error> read_chamber(TomlSection& table, const std::string& path,
                                  const std::optional<ChamberProfile>& profile,
                                  ChamberConfig& into) {
  const bool tcp = table.has("host");
  const bool rtu = table.has("device");
  if (tcp == rtu) {
    table.expected(tcp ? "device" : "host", Errc::bad_input,
                   tcp ? "host (Modbus TCP) or device (Modbus RTU), not both"
                       : "host (Modbus TCP) or device (Modbus RTU)");
  }
  if (rtu) into.address = read_rtu(table);
  if (tcp) into.address = read_tcp(table);
  into.reply_timeout_s = table.number("reply_timeout_s", into.reply_timeout_s, {0.05, 60, "s"});
  into.poll_interval_s = table.number("poll_interval_s", into.poll_interval_s, {0.1, 600, "s"});
  const int unit = static_cast<int>(table.integer("unit", -1, {0, 247}));

  Result<std::optional<ChamberProfile>> found = profile;
  if (profile) {
    static_cast<void>(table.text("profile", ""));  // known, though not looked up
  } else {
    found = named_profile(table, path);
  }
  if (!found) return found.error();
  if (!*found) return std::nullopt;
  into.profile = std::move(**found);
  into.unit = unit >= 0 ? unit : into.profile.unit_default;
  return std::nullopt;
}

}  // namespace gyrocal
