#include <fmt/core.h>

#include <algorithm>

#include "daemon/replay/replay.h"
#include "daemon/report/page.h"

namespace gyrocal::replay {
namespace {

/// XML 1.0 has no control characters.
std::string xml(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20; }, ' ');
  return report::escaped(text);
}

std::string test_case(const std::string& suite, const std::string& name, const std::string& failure,
                      const std::string& details) {
  const auto head = fmt::format("  <testcase classname=\"{}\" name=\"{}\">", xml(suite), xml(name));
  if (failure.empty()) return head + "</testcase>\n";
  return fmt::format("{}<failure message=\"{}\">{}</failure></testcase>\n", head, xml(failure),
                     xml(details));
}

}  // namespace

std::string report_junit(const ReplayReport& report) {
  const auto& difference = report.difference;
  std::string cases;
  for (const ReplayedRun& run : report.runs) {
    const bool differs = difference && difference->run == run.number;
    const auto details = differs ? fmt::format("{}\nexpected: {}\ngot: {}", difference->what,
                                               difference->expected, difference->got)
                                 : std::string();
    cases += test_case(report.recording, fmt::format("run {} does the same today", run.number),
                       differs ? difference->sentence : "", details);
  }
  cases +=
      test_case(report.recording, "a second replay is alike to the last bit",
                report.repeatable ? "" : "two replays of the same recording are not alike", "");
  const int failures = (difference ? 1 : 0) + (report.repeatable ? 0 : 1);
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<testsuite name=\"gyrocal replay\" tests=\"{}\" failures=\"{}\">\n{}</testsuite>\n",
      report.runs.size() + 1, failures, cases);
}

}  // namespace gyrocal::replay
