#include <fmt/core.h>

#include "daemon/replay/replay.h"

namespace gyrocal::replay {
namespace {

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      default:
        out += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;  // XML 1.0 has no others
    }
  }
  return out;
}

std::string test_case(const std::string& suite, const std::string& name, const std::string& failure,
                      const std::string& details) {
  const auto head =
      fmt::format("  <testcase classname=\"{}\" name=\"{}\">", escaped(suite), escaped(name));
  if (failure.empty()) return head + "</testcase>\n";
  return fmt::format("{}<failure message=\"{}\">{}</failure></testcase>\n", head, escaped(failure),
                     escaped(details));
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
