// Reads every source file of the tree and holds its includes against the one rule of the layout:
// an include points only left in compensation <- config <- {schema, drivers} <- daemon <- tests.
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <regex>
#include <set>
#include <string>
#include <vector>

namespace fs = std::filesystem;

namespace {

// schema and drivers share a rank and must not see each other.
const std::map<std::string, int> rank_of = {{"compensation", 0}, {"config", 1}, {"schema", 2},
                                            {"drivers", 2},      {"daemon", 3}, {"tests", 4}};

// The C libraries each have few files that include them; everything else goes through our types.
const std::map<std::string, std::set<std::string>> only_in = {
    {"modbus.h", {"drivers/", "tests/"}},          {"modbus/modbus.h", {"drivers/", "tests/"}},
    {"libserialport.h", {"drivers/board/", "tests/"}}, {"sqlite3.h", {"schema/", "drivers/recording/", "tests/"}},
    {"toml++/toml.h", {"config/"}},
};

struct Include {
  std::string from;  // path below the root
  int line;
  std::string target;
};

std::vector<Include> all_includes(const fs::path& root) {
  static const std::regex pattern(R"re(^\s*#\s*include\s*["<]([^">]+)[">])re");
  std::vector<Include> found;
  for (const auto& [folder, rank] : rank_of) {
    for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
      const auto extension = entry.path().extension();
      if (extension != ".h" && extension != ".cpp" && extension != ".c") continue;
      std::ifstream in(entry.path());
      std::string text;
      for (int line = 1; std::getline(in, text); ++line) {
        std::smatch match;
        if (std::regex_search(text, match, pattern)) {
          found.push_back({fs::relative(entry.path(), root).generic_string(), line, match[1]});
        }
      }
    }
  }
  return found;
}

std::string folder_of(const std::string& path) { return path.substr(0, path.find('/')); }

bool allowed(const std::string& from, const std::string& to) {
  return from == to || rank_of.at(from) > rank_of.at(to);
}

/// A path through `edges` from `node` back to itself, if there is one.
std::optional<std::string> cycle_through(const std::map<std::string, std::set<std::string>>& edges,
                                         const std::string& node, const std::string& start,
                                         std::set<std::string>& seen) {
  const auto next = edges.find(node);
  if (next == edges.end()) return std::nullopt;
  for (const auto& target : next->second) {
    if (target == start) return node + " -> " + target;
    if (!seen.insert(target).second) continue;
    if (auto rest = cycle_through(edges, target, start, seen)) return node + " -> " + *rest;
  }
  return std::nullopt;
}

}  // namespace

TEST_CASE("an include points only left in compensation <- config <- schema, drivers <- daemon") {
  const auto includes = all_includes(GYROCAL_SOURCE_DIR);
  REQUIRE(includes.size() > 20);  // the reader works at all
  for (const auto& include : includes) {
    const std::string to = folder_of(include.target);
    if (!rank_of.contains(to)) continue;
    INFO(include.from << ":" << include.line << " includes " << include.target);
    CHECK(allowed(folder_of(include.from), to));
  }
}

TEST_CASE("files include each other from the root of the tree and never in a circle") {
  std::map<std::string, std::set<std::string>> edges;
  for (const auto& include : all_includes(GYROCAL_SOURCE_DIR)) {
    if (rank_of.contains(folder_of(include.target))) {
      edges[include.from].insert(include.target);
    }
    INFO(include.from << ":" << include.line);
    CHECK(include.target.rfind("..", 0) != 0);
  }
  for (const auto& [from, targets] : edges) {
    std::set<std::string> seen;
    const auto cycle = cycle_through(edges, from, from, seen);
    INFO(cycle.value_or(""));
    CHECK_FALSE(cycle.has_value());
  }
}

TEST_CASE("a C library's header stays in the folder that wraps it") {
  for (const auto& include : all_includes(GYROCAL_SOURCE_DIR)) {
    const auto rule = only_in.find(include.target);
    if (rule == only_in.end()) continue;
    bool inside = false;
    for (const auto& folder : rule->second) inside = inside || include.from.rfind(folder, 0) == 0;
    INFO(include.from << ":" << include.line << " includes " << include.target);
    CHECK(inside);
  }
}

TEST_CASE("the rule refuses what it should") {
  CHECK(allowed("daemon", "compensation"));
  CHECK_FALSE(allowed("compensation", "config"));
  CHECK_FALSE(allowed("drivers", "schema"));
  CHECK_FALSE(allowed("schema", "drivers"));
  CHECK_FALSE(allowed("drivers", "daemon"));
}
