#include "tests/hidden_effects/judging.h"

#include <catch2/catch.hpp>

#include "tests/hidden_effects/judge_report.h"
#include "tests/hidden_effects/units_of_amplitude.h"

using hidden::Answer;
using hidden::Finding;
using hidden::judge;
using hidden::Truth;

namespace {

Truth jump_of_12_mdps() {
  return {"jump",   "0001",        "single",
          "strong", {"explained"}, {{"bias_jump", {{0.012, "dps"}}, true, {}}}};
}
Truth nothing() { return {"null", "0002", "null", "", {"consistent"}, {}}; }
Truth aging_or_heating() {
  return {"both",   "0003",         "confounded",
          "strong", {"confounded"}, {{"aging_drift", {{2.0, "mdps/h"}}, true, {"self_heating"}}}};
}
Truth outsider() {
  return {"ripple", "0004",          "outside",
          "strong", {"unexplained"}, {{"unknown", {{0.02, "dps"}}, true, {}}}};
}
Answer says(const std::string& verdict, std::vector<Finding> findings, double before,
            double after) {
  Answer answer;
  answer.verdict = verdict;
  answer.findings = std::move(findings);
  answer.gap_before = before;
  answer.gap_after = after;
  return answer;
}

hidden::Target target(const std::vector<hidden::Judged>& all, const std::string& name) {
  for (const auto& each : hidden::targets(all)) {
    if (each.name == name) return each;
  }
  FAIL("no target " << name);
  return {};
}

}  // namespace

TEST_CASE("the right name in another unit is found, its error counted with its sign") {
  const auto close =
      judge(jump_of_12_mdps(), says("explained", {{"bias_jump", 12.6, "mdps", {}}}, 2.0, 0.5));
  CHECK(close.found == std::vector<bool>{true});
  CHECK(close.amplitude_error[0].value() == Approx(0.05));
  CHECK(close.wrong_names.empty());
  CHECK(close.gap_closed.value() == Approx(1.0 - 0.25 / 4.0));
  const auto upside_down =
      judge(jump_of_12_mdps(), says("explained", {{"bias_jump", -0.012, "deg/s", {}}}, 2.0, 0.5));
  CHECK(upside_down.amplitude_error[0].value() == Approx(2.0));
}

TEST_CASE("an amplitude in a unit that does not compare is wholly wrong, not left out") {
  const auto session =
      judge(jump_of_12_mdps(), says("explained", {{"bias_jump", 0.012, "furlong", {}}}, 1.0, 0.0));
  CHECK(session.amplitude_error[0].value() == 1.0);
}

TEST_CASE("another name is wrong and the effect stays unfound") {
  const auto session =
      judge(jump_of_12_mdps(), says("explained", {{"aging_drift", 1.0, "mdps/h", {}}}, 2.0, 1.9));
  CHECK(session.found == std::vector<bool>{false});
  CHECK(session.wrong_names == std::vector<std::string>{"aging_drift"});
}

TEST_CASE("a set with the truth in it neither names nor errs where one name was possible") {
  const auto session =
      judge(jump_of_12_mdps(),
            says("confounded", {{"aging_drift", 1.0, "mdps/h", {"bias_jump"}}}, 2.0, 0.0));
  CHECK(session.found == std::vector<bool>{false});
  CHECK(session.wrong_names.empty());
}

TEST_CASE("any name on nothing is a false name; unexplained is none") {
  CHECK(judge(nothing(), says("explained", {{"bias_jump", 1.0, "mdps", {}}}, 0.0, 0.0))
            .wrong_names.size() == 1);
  CHECK(
      judge(nothing(), says("confounded", {{"bias_jump", 1.0, "mdps", {"aging_drift"}}}, 0.0, 0.0))
          .wrong_names.size() == 1);
  CHECK(judge(nothing(), says("unexplained", {{"unknown", 1.0, "mdps", {}}}, 0.0, 0.0))
            .wrong_names.empty());
}

TEST_CASE("confounded is said only with the true effect in the set") {
  CHECK(judge(aging_or_heating(),
              says("confounded", {{"self_heating", 1.0, "degC", {"aging_drift"}}}, 1.0, 0.0))
            .said_confounded);
  CHECK_FALSE(
      judge(aging_or_heating(), says("explained", {{"aging_drift", 2.0, "mdps/h", {}}}, 1.0, 0.0))
          .said_confounded);
  const auto beside =
      judge(aging_or_heating(),
            says("confounded", {{"bias_jump", 1.0, "dps", {"mode_crossing"}}}, 1.0, 0.0));
  CHECK_FALSE(beside.said_confounded);
  CHECK(beside.wrong_names == std::vector<std::string>{"bias_jump|mode_crossing"});
}

TEST_CASE("an outsider is admitted only if nothing of the catalogue is named") {
  CHECK(judge(outsider(), says("unexplained", {{"unknown", 0.02, "dps", {}}}, 1.0, 0.0)).admitted);
  CHECK_FALSE(judge(outsider(),
                    says("unexplained",
                         {{"unknown", 0.02, "dps", {}}, {"mains_hum", 1.0, "mdps", {}}}, 1.0, 0.0))
                  .admitted);
  CHECK(judge(outsider(), says("explained", {{"mains_hum", 1.0, "mdps", {}}}, 1.0, 0.0))
            .wrong_names.size() == 1);
}

TEST_CASE("rates count sessions, and a target without cases neither passes nor fails") {
  const auto right =
      judge(jump_of_12_mdps(), says("explained", {{"bias_jump", 0.012, "dps", {}}}, 2.0, 0.0));
  const auto missed = judge(jump_of_12_mdps(), says("consistent", {}, 2.0, 2.0));
  const std::vector<hidden::Judged> all = {right, missed};
  CHECK(target(all, "strong effects named").value == 0.5);
  CHECK_FALSE(target(all, "strong effects named").passed());
  CHECK(target(all, "moderate effects named").cases == 0);
  CHECK(target(all, "mean share of the excess gap closed").value == 0.5);
  const std::string text = hidden::report_text(all);
  CHECK(text.find("3 passed, 2 failed\n") != std::string::npos);
}

TEST_CASE("a session fails by a wrong name, a false name, a miss or no answer") {
  const auto right = says("explained", {{"bias_jump", 0.012, "dps", {}}}, 2.0, 0.0);
  CHECK(hidden::failings(judge(jump_of_12_mdps(), right)).empty());
  const auto silent = says("consistent", {}, 2.0, 2.0);
  CHECK(hidden::failings(judge(jump_of_12_mdps(), silent)) ==
        std::vector<std::string>{"strong effects named"});
  CHECK(hidden::failings(judge(nothing(), silent)).empty());
  CHECK(hidden::failings(judge(nothing(), right)) ==
        std::vector<std::string>{"false names on nulls"});
  const auto other = says("explained", {{"aging_drift", 1.0, "mdps/h", {}}}, 2.0, 1.9);
  CHECK(hidden::failings(judge(jump_of_12_mdps(), other)) ==
        std::vector<std::string>{"strong effects named", "wrong names"});
  CHECK(hidden::failings(judge(outsider(), other)) ==
        std::vector<std::string>{"wrong names", "outside the catalogue said unexplained"});
  CHECK(hidden::failings(judge(aging_or_heating(), right)) ==
        std::vector<std::string>{"wrong names", "confounded said"});
  auto none = says("", {}, 0.0, 0.0);
  none.trouble = "no answer in 300 s";
  CHECK(hidden::failings(judge(nothing(), none)) ==
        std::vector<std::string>{"every session answered"});
}

TEST_CASE("JUnit has a test case a target and one a session, whatever their names hold") {
  auto truth = jump_of_12_mdps();
  truth.name = "jump <&\">\x01";
  const auto missed = judge(truth, says("consistent", {}, 2.0, 2.0));
  const auto silent = judge(nothing(), says("consistent", {}, 0.0, 0.0));
  const std::string xml = hidden::report_junit({missed, silent});
  CHECK(xml.find("<testsuite name=\"judge: sessions\" tests=\"2\" failures=\"1\">") !=
        std::string::npos);
  CHECK(xml.find("<testcase classname=\"judge.single\" name=\"jump &lt;&amp;&quot;&gt; \" "
                 "time=\"0.000\"><failure message=\"counts against: strong effects named\">hidden: "
                 "bias_jump\nsaid: nothing</failure>") != std::string::npos);
  CHECK(xml.find("<testcase classname=\"judge.null\" name=\"null\" time=\"0.000\"></testcase>") !=
        std::string::npos);
  CHECK(xml.find(
            "<testcase classname=\"judge.target\" name=\"strong effects named\" "
            "time=\"0.000\"><failure message=\"0.0000, wanted at least 0.9500 over 1 cases\">") !=
        std::string::npos);
}

TEST_CASE("answers that are no diagnosis say what is missing") {
  CHECK(hidden::parse_answer("").trouble == "the output is not a JSON object");
  CHECK(hidden::parse_answer("{\"format\":\"x\"}").trouble == "format is not gyrocal-diagnosis/1");
  CHECK(hidden::parse_answer(R"({"format":"gyrocal-diagnosis/1","verdict":"fine"})").trouble ==
        "verdict 'fine' is none of the four");
  CHECK(
      hidden::parse_answer(
          R"({"format":"gyrocal-diagnosis/1","verdict":"explained","findings":[{}],"gap":{"before":1,"after":0}})")
          .trouble == "a finding has no effect");
  const auto good = hidden::parse_answer(
      R"({"format":"gyrocal-diagnosis/1","verdict":"explained","findings":[{"effect":"bias_jump","amplitude":0.1,"unit":"dps","confounded_with":["aging_drift"]}],"gap":{"before":1.5,"after":0.1}})");
  CHECK(good.trouble.empty());
  CHECK(good.findings.at(0).confounded_with == std::vector<std::string>{"aging_drift"});
  CHECK(good.gap_before == 1.5);
}

TEST_CASE("units compare across spellings") {
  const auto same = [](double a, const char* unit_a, double b, const char* unit_b) {
    const auto one = hidden::coherent(a, unit_a);
    const auto two = hidden::coherent(b, unit_b);
    REQUIRE(one.has_value());
    REQUIRE(two.has_value());
    CHECK(one->kind == two->kind);
    CHECK(one->value == Approx(two->value));
  };
  same(1.0, "dps", 1000.0, "mdps");
  same(3600.0, "deg/h", 1.0, "deg/s");
  same(0.02, "dps/(degC/min)", 20.0, "mdps/(°C/min)");
  same(1.0, "%/degC", 0.01, "1/degC");
  same(0.3, "mdps/sqrt(s)", 0.3, "mdps/√s");
  same(2.0, "°C", 2.0, "K");
  CHECK_FALSE(hidden::coherent(1.0, "furlong").has_value());
}
