#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/bench/child_process.h"
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

}  // namespace

std::optional<PythonPeer> run_python_peer(
    const std::map<std::string, std::vector<double>>& signals) {
  const fs::path folder = fs::temp_directory_path() / ("gyrocal_bench." + std::to_string(getpid()));
  fs::create_directory(folder);
  for (const auto& [name, signal] : signals) write_doubles(folder / (name + ".f64"), signal);
  std::optional<PythonPeer> peer;
  if (const auto child = run_python({GYROCAL_PYTHON_PEER, folder.string()})) {
    const auto json = nlohmann::json::parse(child->printed);
    peer = PythonPeer{json.at("versions"), json.at("seconds"), {}};
    for (const auto& [name, signal] : signals) {
      peer->results[name] = read_doubles(folder / (name + ".result"));
    }
  }
  fs::remove_all(folder);
  return peer;
}

}  // namespace gyrocal::bench
