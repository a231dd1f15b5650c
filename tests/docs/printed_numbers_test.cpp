// A number with a decimal point on a page is a result, printed by a command that the page names, or
// it is listed here with the reason why no command prints it.
#include <algorithm>
#include <catch2/catch.hpp>
#include <map>
#include <regex>
#include <set>

#include "config/text_file.h"
#include "tests/daemon/cli/run_gyrocal.h"
#include "tests/docs/fenced_blocks.h"

using namespace gyrocal;

namespace {

struct Sources {
  std::vector<std::string> commands;               ///< of gyrocal; they print the page's numbers
  std::map<std::string, std::string> not_printed;  ///< number -> where it comes from instead
  /// What prints the numbers but takes too long for a test; the page names it. Empty: nothing.
  std::string slow = "";
};

std::map<std::string, Sources> sources_of_pages() {
  const std::string demo = temporary_file("demo.db", "") + ".new";
  return {
      {"README.md",
       {{"run " GYROCAL_SOURCE_DIR "/config/campaigns/demo.toml --virtual --seed 7 --db " + demo},
        {}}},
      {"docs/architecture.md", {}},
      {"docs/database.md", {}},
      {"docs/diagnose.md", {{}, {}, "make judge"}},
      {"docs/exit_codes.md", {}},
      {"docs/first-campaign.md",
       {{},
        {{"0.5", "the step of the board's temperature sensor, of its data sheet"},
         {"4.13", "the paper's scale, in config/campaigns/weekend.toml"},
         {"4.657", "the data sheet of the yaw gyro"}}}},
      {"docs/numerics.md",
       {{},
        {{"0.6745", "of the definition of P: the median of |x| of a normal deviate"},
         {"1.4", "of the definition of the score"}}}},
      {"docs/paper.md",
       {{"paper", "paper --dwell-deviation", "paper --examine", "paper --table-1"},
        {{"3.3", "the volts that the board's converter counts over"}}}},
      {"docs/performance.md", {{}, {}, "make bench"}},
      {"docs/queries.md", {}},
      {"docs/replay.md", {}},
      {"docs/status.md", {}},
  };
}

/// Numbers with one decimal point; what has more is an address.
std::set<std::string> numbers_of(const std::string& text) {
  static const std::regex number("[0-9]+(\\.[0-9]+)+");
  std::set<std::string> found;
  for (std::sregex_iterator at(text.begin(), text.end(), number), end; at != end; ++at) {
    const std::string word = at->str();
    if (std::count(word.begin(), word.end(), '.') == 1) found.insert(word);
  }
  return found;
}

std::set<std::string> numbers_printed_by(const std::vector<std::string>& commands) {
  std::string printed;
  for (const auto& command : commands) {
    const auto ran = run_gyrocal(command);
    INFO(command << ran.err);
    CHECK(ran.exit_code == 0);
    printed += ran.out;
  }
  return numbers_of(printed);
}

}  // namespace

TEST_CASE("every result that a page quotes is printed by a command it names", "[docs]") {
  const auto known = sources_of_pages();
  std::size_t checked = 0;
  for (const auto& page : pages()) {
    CAPTURE(page);
    REQUIRE(known.contains(page));
    const Sources& sources = known.at(page);
    const std::string text = page_text(page);
    const auto quoted = numbers_of(text);
    if (!sources.slow.empty()) {
      CHECK(text.find(sources.slow) != std::string::npos);
      continue;
    }
    for (const auto& command : sources.commands) {
      CHECK(text.find("gyrocal " + command.substr(0, command.find(' '))) != std::string::npos);
    }
    const auto printed = numbers_printed_by(sources.commands);
    for (const auto& number : quoted) {
      CAPTURE(number);
      CHECK(printed.contains(number) != sources.not_printed.contains(number));
      if (printed.contains(number)) ++checked;
    }
    for (const auto& [number, reason] : sources.not_printed) {
      CAPTURE(number, reason);
      CHECK(quoted.contains(number));
    }
  }
  CHECK(checked >= 60);
}
