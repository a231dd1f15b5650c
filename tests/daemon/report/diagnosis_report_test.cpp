#include "daemon/report/diagnosis_report.h"

#include <catch2/catch.hpp>

#include "compensation/rig/simulate_session.h"
#include "tests/compensation/quiet_rig.h"

using namespace gyrocal;

namespace {

Session hysteresis_session() {
  rig::RigModel model = quiet_rig();
  model.effects.push_back(
      {.effect = "thermal_hysteresis", .law = "play", .parameters = {{"h", 0.05}, {"w", 3}}});
  rig::SessionPlan plan;
  plan.setpoints_c = {-10, 5, 20, 35, 50};
  plan.sweep = rig::Sweep::up_down;
  return rig::simulate_session(model, plan, 3);
}

std::size_t figures_in(const std::string& html) {
  std::size_t figures = 0;
  for (std::size_t at = 0; (at = html.find("<figure>", at)) != std::string::npos; ++at) ++figures;
  return figures;
}

}  // namespace

TEST_CASE("the report of a hidden hysteresis names it and shows the gap shrink", "[report]") {
  const Session session = hysteresis_session();
  const Diagnosis diagnosis = diagnose(session, rig::RigModel{}, {}).value();
  REQUIRE(diagnosis.verdict == Verdict::explained);
  const std::string html =
      report::diagnosis_report(session, diagnosis, {"monday", "default", "0.1.0"}).value();
  CHECK(html.find("<strong>explained</strong>") != std::string::npos);
  CHECK(html.find("<td>thermal_hysteresis</td>") != std::string::npos);
  CHECK(html.find("with thermal_hysteresis") != std::string::npos);
  CHECK(html.find("Rig model default; gyrocal 0.1.0.") != std::string::npos);
  CHECK(figures_in(html) == 5);
  CHECK(html.size() < 3'000'000);
}

TEST_CASE("a session without a slow stream has a report of the rows made for it", "[report]") {
  Session session = hysteresis_session();
  session.monitor.clear();
  const Diagnosis diagnosis = diagnose(session, rig::RigModel{}, {}).value();
  const std::string html =
      report::diagnosis_report(session, diagnosis, {"monday", "default", "0.1.0"}).value();
  CHECK(figures_in(html) == 5);
  CHECK(html.find("monitor.csv has 0 rows") != std::string::npos);
}
