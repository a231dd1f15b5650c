// Whoever types what README and docs print gets what they print. Blocks fenced "sh" must end well;
// in blocks fenced "console" what follows "$ command" must be what it prints, a line "..." standing
// for any lines. A page's blocks run in order in one folder that holds config/, tests/recordings/
// and paper data as the source tree does. A block whose first line is "# not run here: REASON" is
// left out and listed below.
#include <sys/wait.h>

#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <set>
#include <sstream>

#include "config/text_file.h"
#include "tests/docs/fenced_blocks.h"
#include "tests/schema/temporary_folder.h"

namespace {

namespace fs = std::filesystem;

const std::string not_run("# not run here: ");

/// Every block that the test leaves out: page, then its reason. New ones need a line here.
const std::set<std::pair<std::string, std::string>> known_not_run{
    {"README.md", "minutes; `make demo` and `make test` are the CI's own jobs"},
    {"README.md", "needs a chamber and boards"},
    {"docs/first-campaign.md", "needs a chamber and boards"},
    {"docs/first-campaign.md", "needs root"},
    {"docs/replay.md", "needs a recorded campaign"},
};

/// A folder that looks like the source tree to the commands of a page.
void furnish(const TemporaryFolder& folder) {
  for (const char* name : {"config", "tests", "docs", "README.md", "Makefile"}) {
    fs::create_symlink(fs::path(GYROCAL_SOURCE_DIR) / name, folder / name);
  }
}

struct Run {
  int code;
  std::string out;
};
Run run(const TemporaryFolder& folder, const std::string& script) {
  write_file(folder / "block.sh", script);
  const auto command = "cd '" + folder.path() + "' && PATH='" + GYROCAL_PROGRAMS +
                       "':\"$PATH\" NO_COLOR=1 bash -euo pipefail block.sh >block.out "
                       "2>block.err </dev/null";
  const int status = std::system(command.c_str());
  INFO(gyrocal::read_text_file(folder / "block.err").value());
  CHECK(WIFEXITED(status));
  return {WEXITSTATUS(status), gyrocal::read_text_file(folder / "block.out").value() +
                                   gyrocal::read_text_file(folder / "block.err").value()};
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) {
    lines.push_back(line.substr(0, line.find_last_not_of(' ') + 1));
  }
  return lines;
}

/// Whether `got` is `wanted` where "..." stands for any lines.
bool matches(const std::vector<std::string>& wanted, std::size_t w,
             const std::vector<std::string>& got, std::size_t g) {
  if (w == wanted.size()) return g == got.size();
  if (wanted[w] == "...") {
    for (std::size_t skip = g; skip <= got.size(); ++skip) {
      if (matches(wanted, w + 1, got, skip)) return true;
    }
    return false;
  }
  return g < got.size() && wanted[w] == got[g] && matches(wanted, w + 1, got, g + 1);
}

void check_console(const TemporaryFolder& folder, const std::string& text) {
  std::string command;
  std::string wanted;
  const auto check = [&] {
    if (command.empty()) return;
    const auto ran = run(folder, command);
    INFO("$ " << command << ran.out);
    CHECK(ran.code == 0);
    CHECK(matches(lines_of(wanted), 0, lines_of(ran.out), 0));
  };
  for (const auto& line : lines_of(text)) {
    if (line.starts_with("$ ")) {
      check();
      command = line.substr(2) + '\n';
      wanted.clear();
    } else {
      wanted += line + '\n';
    }
  }
  check();
}

}  // namespace

TEST_CASE("every command block of README and docs does what the page says", "[docs]") {
  std::set<std::pair<std::string, std::string>> left_out;
  int ran = 0;
  for (const auto& page : pages()) {
    const TemporaryFolder folder;
    furnish(folder);
    for (const auto& block : fenced_blocks(page_text(page))) {
      CAPTURE(page, block.line);
      if (block.text.starts_with(not_run)) {
        const auto reason =
            block.text.substr(not_run.size(), block.text.find('\n') - not_run.size());
        CHECK(known_not_run.contains({page, reason}));
        left_out.insert({page, reason});
      } else if (block.language == "sh") {
        const auto done = run(folder, block.text);
        INFO(done.out);
        CHECK(done.code == 0);
        ++ran;
      } else if (block.language == "console") {
        check_console(folder, block.text);
        ++ran;
      }
    }
  }
  CHECK(left_out == known_not_run);
  CHECK(ran >= 8);
}

TEST_CASE("a fence names what stands in it", "[docs]") {
  const std::set<std::string> languages{"sh",   "console", "text", "sql", "json",
                                        "toml", "c",       "yaml", "http"};
  for (const auto& page : pages()) {
    for (const auto& block : fenced_blocks(page_text(page))) {
      CAPTURE(page, block.line, block.language);
      CHECK(languages.contains(block.language));
    }
  }
}
