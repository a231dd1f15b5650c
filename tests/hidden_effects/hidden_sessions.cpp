// gyrocal_hidden_sessions: writes measured sessions with something hidden in them, and, outside the
// session directories, what it was.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <atomic>
#include <cstdio>
#include <filesystem>
#include <thread>

#include "tests/hidden_effects/case_list.h"

namespace {

namespace fs = std::filesystem;

struct Options {
  std::string out;
  std::string set = "short";
  std::uint64_t seed = 1;
  std::string only;
  bool list = false;
  unsigned jobs = 1;
};

struct Numbered {
  std::string id;  ///< a number, not a name: the judged program sees the path
  hidden::Listed listed;
};

std::vector<Numbered> chosen(const Options& options) {
  std::vector<Numbered> cases;
  int number = 0;
  for (auto& listed : hidden::list_cases(options.set, options.seed)) {
    std::string digits = std::to_string(++number);
    digits.insert(0, 4 - std::min<std::size_t>(digits.size(), 4), '0');
    if (listed.name.find(options.only) != std::string::npos) {
      cases.push_back({digits, std::move(listed)});
    }
  }
  return cases;
}

/// A case depends on its own seed only, so any number of threads writes the same.
bool write_all(const std::vector<Numbered>& cases, const fs::path& out, unsigned jobs) {
  std::atomic<std::size_t> next = 0;
  std::atomic<bool> good = true;
  const auto work = [&] {
    for (std::size_t i = next++; i < cases.size() && good; i = next++) {
      const auto& [id, listed] = cases[i];
      const auto trouble =
          hidden::write_case(listed.make(), out / "sessions" / id, out / "truth" / (id + ".json"));
      if (!trouble.empty()) good = false;
      std::fprintf(stderr, "%s %s %s\n", id.c_str(), listed.name.c_str(), trouble.c_str());
    }
  };
  std::vector<std::thread> workers;
  for (unsigned k = 0; k < jobs; ++k) workers.emplace_back(work);
  for (auto& worker : workers) worker.join();
  return good;
}

int run(const Options& options) {
  const auto cases = chosen(options);
  if (cases.empty()) {
    std::fprintf(stderr, "no case of the %s set has '%s' in its name; see --list\n",
                 options.set.c_str(), options.only.c_str());
    return 2;
  }
  if (options.list) {
    for (const auto& [id, listed] : cases) std::printf("%s %s\n", id.c_str(), listed.name.c_str());
    return 0;
  }
  std::error_code failed;
  fs::create_directories(fs::path(options.out) / "truth", failed);
  if (failed) {
    std::fprintf(stderr, "cannot make %s: %s\n", options.out.c_str(), failed.message().c_str());
    return 1;
  }
  return write_all(cases, options.out, options.jobs) ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Example: gyrocal_hidden_sessions --out /tmp/hidden --set short --seed 7"};
  Options options;
  app.add_option("--out", options.out, "folder for sessions/NNNN and truth/NNNN.json")->required();
  app.add_option("--set", options.set, "which list of cases")
      ->check(CLI::IsMember({"short", "full"}))
      ->capture_default_str();
  app.add_option("--seed", options.seed, "another seed, other sessions")->capture_default_str();
  app.add_option("--only", options.only, "cases with this in their name");
  app.add_option("--jobs", options.jobs, "cases written at once")
      ->check(CLI::Range(1u, 64u))
      ->capture_default_str();
  app.add_flag("--list", options.list, "print the cases, write nothing");
  CLI11_PARSE(app, argc, argv);
  return run(options);
}
