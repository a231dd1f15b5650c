#include "tests/bench/python_peer.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "tests/bench/scratch.h"

namespace gyrocal::bench {
namespace {

namespace fs = std::filesystem;

constexpr int package_missing = 3;

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

std::optional<ChildResult> run_python(const std::string& script,
                                      const std::vector<std::string>& arguments) {
  for (const char* python : {"python3", "/usr/bin/python3"}) {
    std::vector<std::string> all{python, "-B", fmt::format("{}/{}", GYROCAL_BENCH_SCRIPTS, script)};
    all.insert(all.end(), arguments.begin(), arguments.end());
    auto result = run_child(all);
    if (!result || result->exit_code == package_missing) continue;
    if (result->exit_code == 0) return result;
    fmt::print(stderr, "bench: {} ended with exit code {}\n", fmt::join(all, " "),
               result->exit_code);
    return std::nullopt;
  }
  return std::nullopt;
}

std::optional<nlohmann::json> ask_python(const std::string& script,
                                         const std::vector<std::string>& arguments) {
  const auto ran = run_python(script, arguments);
  return ran ? std::optional(nlohmann::json::parse(ran->printed)) : std::nullopt;
}

Spread spread_from(const nlohmann::json& three) { return {three.at(0), three.at(1), three.at(2)}; }

SignalPeer::SignalPeer(const Signals& signals) {
  const Scratch folder;
  for (const auto& [name, signal] : signals) write_doubles(folder / (name + ".f64"), signal);
  const auto json = ask_python("signal_peer.py", {folder.path()});
  if (!json) return;
  versions_ = json->at("versions").get<std::map<std::string, std::string>>();
  for (const auto& [name, signal] : signals) {
    took_s_[name] = spread_from(json->at("seconds").at(name));
    results_[name] = read_doubles(folder / (name + ".result"));
  }
}

Peer SignalPeer::pywavelets(const std::string& job) const {
  if (!took_s_.contains(job)) return {"PyWavelets", {}, "python3-pywt"};
  return {"PyWavelets " + versions_.at("pywt"), took_s_.at(job), ""};
}

Peer SignalPeer::numpy(const std::string& job) const {
  if (!took_s_.contains(job)) return {"NumPy", {}, "python3-numpy"};
  return {"NumPy " + versions_.at("numpy"), took_s_.at(job), ""};
}

std::string SignalPeer::difference(const std::string& job, std::span<const double> ours) const {
  if (!results_.contains(job)) return "nothing to compare with";
  return fmt::format("differs by {:.1e}", largest_difference(ours, results_.at(job)));
}

double largest_difference(std::span<const double> a, std::span<const double> b) {
  if (a.size() != b.size()) return INFINITY;
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::abs(a[i] - b[i]));
  return largest;
}

}  // namespace gyrocal::bench
