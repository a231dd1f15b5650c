// The numbers of pages that quote results stand in what the commands print that the page names.
#include <catch2/catch.hpp>
#include <map>
#include <regex>
#include <set>

#include "config/text_file.h"
#include "tests/daemon/cli/run_gyrocal.h"
#include "tests/docs/fenced_blocks.h"

using namespace gyrocal;

namespace {

/// Every number with four decimals, as the results are printed.
std::set<std::string> numbers_of(const std::string& text) {
  static const std::regex number("\\b[0-9]+\\.[0-9]{4}\\b");
  std::set<std::string> found;
  for (std::sregex_iterator at(text.begin(), text.end(), number), end; at != end; ++at) {
    found.insert(at->str());
  }
  return found;
}

}  // namespace

TEST_CASE("every result that a page quotes is printed by a command it names", "[docs]") {
  const std::string demo = temporary_file("demo.db", "") + ".new";
  const std::map<std::string, std::vector<std::string>> commands{
      {"docs/paper.md", {"paper", "paper --dwell-deviation", "paper --examine", "paper --table-1"}},
      {"README.md",
       {"run " GYROCAL_SOURCE_DIR "/config/campaigns/demo.toml --virtual --seed 7 --db " + demo}}};
  for (const auto& [page, named] : commands) {
    std::string printed;
    for (const auto& command : named) {
      const auto ran = run_gyrocal(command);
      CHECK(ran.exit_code == 0);
      printed += ran.out;
    }
    const auto known = numbers_of(printed);
    const auto quoted = numbers_of(page_text(page));
    CHECK(quoted.size() >= 10);
    for (const auto& number : quoted) {
      CAPTURE(page, number);
      CHECK(known.contains(number));
    }
  }
}
