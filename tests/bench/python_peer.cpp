#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/bench/peers.h"

namespace gyrocal::bench {
namespace {

namespace fs = std::filesystem;

void write_doubles(const fs::path& path, const std::vector<double>& values) {
  std::ofstream file(path, std::ios::binary);
  file.write(reinterpret_cast<const char*>(values.data()),
             static_cast<std::streamsize>(values.size() * sizeof(double)));
}

std::vector<double> read_doubles(const fs::path& path) {
  std::vector<double> values(fs::file_size(path) / sizeof(double));
  std::ifstream file(path, std::ios::binary);
  file.read(reinterpret_cast<char*>(values.data()),
            static_cast<std::streamsize>(values.size() * sizeof(double)));
  return values;
}

std::optional<std::string> printed_by(const std::string& command) {
  std::FILE* const pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) return std::nullopt;
  std::string text;
  char block[4096];
  while (std::fgets(block, sizeof block, pipe) != nullptr) text += block;
  return pclose(pipe) == 0 ? std::optional(text) : std::nullopt;
}

}  // namespace

std::optional<PythonPeer> run_python_peer(
    const std::map<std::string, std::vector<double>>& signals) {
  const fs::path folder = fs::temp_directory_path() / ("gyrocal_bench." + std::to_string(getpid()));
  fs::create_directory(folder);
  for (const auto& [name, signal] : signals) write_doubles(folder / (name + ".f64"), signal);
  std::optional<PythonPeer> peer;
  // Debian's packages belong to Debian's interpreter, which need not be the first in the path.
  for (const char* python : {"python3", "/usr/bin/python3"}) {
    const auto printed = printed_by(std::string(python) + " " GYROCAL_PYTHON_PEER " " +
                                    folder.string() + " 2>/dev/null");
    if (!printed) continue;
    const auto json = nlohmann::json::parse(*printed);
    peer = PythonPeer{json.at("versions"), json.at("seconds"), {}};
    for (const auto& [name, signal] : signals) {
      peer->results[name] = read_doubles(folder / (name + ".result"));
    }
    break;
  }
  fs::remove_all(folder);
  return peer;
}

}  // namespace gyrocal::bench
