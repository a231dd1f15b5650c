// A number with a decimal point, and one with a unit, is a result: printed by a command that the
// page names, or listed here with the reason why no command prints it.
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
  /// Of gyrocal; they print the page's numbers. "!" before one that exits with another code than 0.
  std::vector<std::string> commands;
  std::map<std::string, std::string> not_printed;  ///< number -> where it comes from instead
  /// What prints the numbers but takes too long for a test; the page names it. Empty: nothing.
  std::string slow = "";
};

std::map<std::string, Sources> sources_of_pages() {
  const std::string demo = temporary_file("demo.db", "") + ".new";
  return {
      {"README.md",
       {{"run " GYROCAL_SOURCE_DIR "/config/campaigns/demo.toml --virtual --seed 7 --db " + demo},
        {{"50 °C", "the paper's highest setpoint"}}}},
      {"docs/architecture.md", {}},
      {"docs/database.md",
       {{}, {{"20 degC", "an example of a question"}, {"95 %", "which intervals"}}}},
      {"docs/diagnose.md", {{}, {}, "make judge"}},
      {"docs/exit_codes.md", {}},
      {"docs/first-campaign.md",
       {{"!check " GYROCAL_SOURCE_DIR "/config/campaigns/weekend.toml --db " + demo},
        {{"0.5", "the step of the board's temperature sensor, of its data sheet"},
         {"4.13", "the paper's scale, in config/campaigns/weekend.toml"},
         {"4.657", "the data sheet of the yaw gyro"}}}},
      {"docs/numerics.md",
       {{},
        {{"0.6745", "of the definition of P: the median of |x| of a normal deviate"},
         {"1.4", "of the definition of the score"},
         {"25 degC", "an example"},
         {"95 %", "which intervals"},
         {"35 degC", "an example"}}}},
      {"docs/paper.md",
       {{"paper", "paper --dwell-deviation", "paper --examine", "paper --table-1"},
        {{"3.3", "the volts that the board's converter counts over"}}}},
      {"docs/performance.md", {{}, {}, "make bench"}},
      {"docs/queries.md", {}},
      {"docs/replay.md", {}},
      {"docs/status.md",
       {{},
        {{"2 s", "daemon/status/http_server.cpp"},
         {"5 s", "daemon/status/"},
         {"10 s", "daemon/status/http_server.cpp"},
         {"20 s", "daemon/notify/"},
         {"60 s", "daemon/notify/watcher.cpp, mosquitto_broker.cpp"},
         {"160 s", "daemon/notify/outbox.h: 10 s, then four times as long each"}}}},
  };
}

std::set<std::string> matches(const std::string& text, const std::regex& pattern, int group) {
  std::set<std::string> found;
  for (std::sregex_iterator at(text.begin(), text.end(), pattern), end; at != end; ++at) {
    found.insert(at->str(static_cast<std::size_t>(group)));
  }
  return found;
}

/// Numbers with one decimal point; what has more is an address.
std::set<std::string> decimals_of(const std::string& text) {
  static const std::regex number("[0-9]+(\\.[0-9]+)+");
  auto found = matches(text, number, 0);
  std::erase_if(found, [](const auto& word) { return std::ranges::count(word, '.') != 1; });
  return found;
}

/// "37 hours": whole numbers of a page's sentences that have a unit.
std::set<std::string> figures_of(const std::string& text) {
  static const std::regex blocks("```[^`]*```");
  static const std::regex figure(
      "(^|[^-0-9.,/_A-Za-z])([0-9]+ "
      "?(%|(ms|s|MB|kB|hours|minutes|min|days|samples|setpoints|boards|"
      "degC|°C|nats|Hz|bytes)\\b))");
  return matches(std::regex_replace(text, blocks, ""), figure, 2);
}

/// Decimals and whole numbers, as a command prints them.
std::set<std::string> numbers_of(const std::string& text) {
  static const std::regex whole("(^|[^0-9.])([0-9]+)");
  auto found = decimals_of(text);
  found.merge(matches(text, whole, 2));
  return found;
}

std::string number_in(const std::string& quoted) {
  return quoted.substr(0, quoted.find_first_not_of("0123456789."));
}

std::string name_of(const std::string& command) {
  const std::size_t begin = command.starts_with('!') ? 1 : 0;
  return command.substr(begin, command.find(' ') - begin);
}

std::set<std::string> numbers_printed_by(const std::vector<std::string>& commands) {
  std::string printed;
  for (const auto& command : commands) {
    const bool fails = command.starts_with('!');
    const auto ran = run_gyrocal(command.substr(fails ? 1 : 0));
    INFO(command << ran.err);
    CHECK((ran.exit_code != 0) == fails);
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
    auto quoted = decimals_of(text);
    quoted.merge(figures_of(text));
    if (!sources.slow.empty()) {
      CHECK(text.find(sources.slow) != std::string::npos);
      continue;
    }
    for (const auto& command : sources.commands) {
      CHECK(text.find("gyrocal " + name_of(command)) != std::string::npos);
    }
    const auto printed = numbers_printed_by(sources.commands);
    for (const auto& number : quoted) {
      CAPTURE(number);
      const bool is_printed = printed.contains(number_in(number));
      CHECK(is_printed != sources.not_printed.contains(number));
      if (is_printed) ++checked;
    }
    for (const auto& [number, reason] : sources.not_printed) {
      CAPTURE(number, reason);
      CHECK(quoted.contains(number));
    }
  }
  CHECK(checked >= 60);
}
