// gyrocal_hidden_sessions: writes measured sessions with something hidden in them, and, outside the
// session directories, what it was.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>

#include "tests/hidden_effects/case_list.h"

namespace {

struct Options {
  std::string out;
  std::string set = "short";
  std::uint64_t seed = 1;
  std::string only;
  bool list = false;
};

int write_all(const Options& options) {
  namespace fs = std::filesystem;
  int number = 0;
  int written = 0;
  std::error_code failed;
  fs::create_directories(fs::path(options.out) / "truth", failed);
  if (failed) {
    std::fprintf(stderr, "cannot make %s: %s\n", options.out.c_str(), failed.message().c_str());
    return 1;
  }
  for (const auto& listed : hidden::list_cases(options.set, options.seed)) {
    ++number;
    if (listed.name.find(options.only) == std::string::npos) continue;
    ++written;
    if (options.list) {
      std::printf("%04d %s\n", number, listed.name.c_str());
      continue;
    }
    // A number, not a name: the judged program sees the path.
    char id[16];
    std::snprintf(id, sizeof id, "%04d", number);
    const auto trouble =
        hidden::write_case(listed.make(), fs::path(options.out) / "sessions" / id,
                           fs::path(options.out) / "truth" / (std::string(id) + ".json"));
    if (!trouble.empty()) {
      std::fprintf(stderr, "%s: %s\n", listed.name.c_str(), trouble.c_str());
      return 1;
    }
    std::fprintf(stderr, "%s %s\n", id, listed.name.c_str());
  }
  if (written == 0) {
    std::fprintf(stderr, "no case of the %s set has '%s' in its name; see --list\n",
                 options.set.c_str(), options.only.c_str());
    return 2;
  }
  return 0;
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
  app.add_flag("--list", options.list, "print the cases, write nothing");
  CLI11_PARSE(app, argc, argv);
  return write_all(options);
}
