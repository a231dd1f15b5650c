#include "tests/hidden_effects/judge_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <map>

namespace hidden {
namespace {

std::string joined(const std::vector<std::string>& words, const std::string& between) {
  std::string text;
  for (const auto& word : words) text += (text.empty() ? "" : between) + word;
  return text;
}

std::string hidden_names(const Truth& truth) {
  std::vector<std::string> list;
  for (const auto& effect : truth.effects) list.push_back(effect.name);
  return list.empty() ? "nothing" : joined(list, " + ");
}

std::string said(const Answer& answer) {
  if (!answer.trouble.empty()) return "no answer";
  std::vector<std::string> list;
  for (const auto& finding : answer.findings) {
    std::vector<std::string> set = finding.confounded_with;
    set.push_back(finding.effect);
    std::sort(set.begin(), set.end());
    list.push_back(joined(set, "|"));
  }
  return list.empty() ? "nothing" : joined(list, " + ");
}

std::string session_line(const Judged& session) {
  std::string line =
      fmt::format("{:44} {:11} {}", session.truth.name,
                  session.answer.trouble.empty() ? session.answer.verdict : "-",
                  session.answer.trouble.empty() ? said(session.answer) : session.answer.trouble);
  for (std::size_t i = 0; i < session.amplitude_error.size(); ++i) {
    if (session.amplitude_error[i]) {
      line += fmt::format("  [{} off by {:.1f} %]", session.truth.effects[i].name,
                          100.0 * *session.amplitude_error[i]);
    }
  }
  if (session.gap_closed)
    line += fmt::format("  [gap closed {:.0f} %]", 100.0 * *session.gap_closed);
  return line + fmt::format("  {:.1f} s\n", session.answer.seconds);
}

/// Sparse: most of 24 x 24 cells would be empty.
std::string confusion(const std::vector<Judged>& all) {
  std::map<std::string, std::map<std::string, int>> cells;
  for (const auto& session : all) {
    const std::string row = session.truth.category == "outside" ? "(outside the catalogue)"
                                                                : hidden_names(session.truth);
    ++cells[row + (session.truth.category == "confounded" ? " (confounded)" : "")]
           [said(session.answer)];
  }
  std::string text = "\nhidden -> said (sessions)\n";
  for (const auto& [row, answers] : cells) {
    std::vector<std::string> counted;
    for (const auto& [answer, count] : answers)
      counted.push_back(fmt::format("{} x{}", answer, count));
    text += fmt::format("  {:44} -> {}\n", row, joined(counted, ", "));
  }
  return text;
}

std::string timing(const std::vector<Judged>& all) {
  std::vector<double> seconds;
  for (const auto& session : all) seconds.push_back(session.answer.seconds);
  const double longest = seconds.empty() ? 0.0 : *std::max_element(seconds.begin(), seconds.end());
  return fmt::format("\nseconds a session: median {:.2f}, longest {:.2f}\n", median(seconds),
                     longest);
}

std::string target_line(const Target& target) {
  if (target.cases == 0) return fmt::format("  --   {:40} no cases\n", target.name);
  return fmt::format("  {:4} {:40} {:6.1f} %  wanted {} {:.0f} %  ({} cases)\n",
                     target.passed() ? "ok" : "FAIL", target.name, 100.0 * target.value,
                     target.at_least ? ">=" : "<=", 100.0 * target.wanted, target.cases);
}

/// XML 1.0 has no control characters but these three.
std::string xml(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '<') {
      out += "&lt;";
    } else if (c == '>') {
      out += "&gt;";
    } else if (c == '&') {
      out += "&amp;";
    } else if (c == '"') {
      out += "&quot;";
    } else if (static_cast<unsigned char>(c) < 0x20 && c != '\n' && c != '\r' && c != '\t') {
      out += ' ';
    } else {
      out += c;
    }
  }
  return out;
}

/// The test cases of one JUnit suite.
class Suite {
 public:
  explicit Suite(std::string name) : name_(std::move(name)) {}

  /// @param failure  empty: passed.
  void add(const std::string& of, const std::string& name, double seconds,
           const std::string& failure, const std::string& details) {
    ++tests_;
    cases_ += fmt::format("    <testcase classname=\"{}\" name=\"{}\" time=\"{:.3f}\">", xml(of),
                          xml(name), seconds);
    if (!failure.empty()) {
      ++failures_;
      cases_ += fmt::format("<failure message=\"{}\">{}</failure>", xml(failure), xml(details));
    }
    cases_ += "</testcase>\n";
  }
  std::string text() const {
    return fmt::format("  <testsuite name=\"{}\" tests=\"{}\" failures=\"{}\">\n{}  </testsuite>\n",
                       xml(name_), tests_, failures_, cases_);
  }

 private:
  std::string name_;
  int tests_ = 0, failures_ = 0;
  std::string cases_;
};

Suite suite_of_targets(const std::vector<Judged>& all) {
  Suite suite("judge: targets");
  for (const auto& target : targets(all)) {
    if (target.cases == 0) continue;
    const auto missed =
        fmt::format("{:.4f}, wanted {} {:.4f} over {} cases", target.value,
                    target.at_least ? "at least" : "at most", target.wanted, target.cases);
    suite.add("judge.target", target.name, 0.0, target.passed() ? "" : missed,
              joined(target.culprits, "\n"));
  }
  return suite;
}

Suite suite_of_sessions(const std::vector<Judged>& all) {
  Suite suite("judge: sessions");
  for (const auto& session : all) {
    const auto failure = joined(failings(session), "; ");
    suite.add("judge." + session.truth.category, session.truth.name, session.answer.seconds,
              failure.empty() ? "" : "counts against: " + failure,
              fmt::format(
                  "hidden: {}\nsaid: {}", hidden_names(session.truth),
                  session.answer.trouble.empty() ? said(session.answer) : session.answer.trouble));
  }
  return suite;
}

}  // namespace

std::string report_text(const std::vector<Judged>& all) {
  std::string text;
  for (const auto& session : all) text += session_line(session);
  text += confusion(all) + timing(all) + "\n";
  int passed = 0;
  int failed = 0;
  for (const auto& target : targets(all)) {
    text += target_line(target);
    if (target.cases > 0) ++(target.passed() ? passed : failed);
  }
  return text + fmt::format("{} passed, {} failed\n", passed, failed);
}

std::string report_junit(const std::vector<Judged>& all) {
  return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites>\n" +
         suite_of_targets(all).text() + suite_of_sessions(all).text() + "</testsuites>\n";
}

}  // namespace hidden
