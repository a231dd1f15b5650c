#include "daemon/campaign/campaign.h"

#include <fmt/core.h>

#include <type_traits>

#include "compensation/values/assert.h"
#include "daemon/campaign/overloaded.h"

namespace gyrocal::campaign {
namespace {

Celsius target(const Plan& plan, const Visit& visit) {
  GYROCAL_ASSERT(visit.point < plan.setpoints.size());
  return plan.setpoints[visit.point];
}

Step go_to(const Plan& plan, const Visit& visit) {
  return {Ramping{visit}, {RampTo{target(plan, visit)}}};
}

Step go_home(const Plan& plan, bool aborting) { return {Returning{aborting}, {RampTo{plan.safe}}}; }

Step next_point(const Plan& plan, const Visit& visit) {
  if (visit.point + 1 == plan.setpoints.size()) return go_home(plan, false);
  return go_to(plan, Visit{visit.point + 1});
}

Step with(Action first, Step then) {
  then.actions.insert(then.actions.begin(), std::move(first));
  return then;
}

Say point_failed(const Plan& plan, const Visit& visit, const std::string& why) {
  return {
      "error", "setpoint_failed",
      fmt::format("setpoint {:.1f} degC given up after {}: {}", target(plan, visit).value,
                  visit.disturbed == 0 ? "one try" : fmt::format("{} tries", visit.disturbed + 1),
                  why)};
}

/// The next try at the same setpoint, from its ramp on: whatever spoilt the last one may have
/// moved the air. Past the limit the setpoint has failed and the campaign goes on without it.
Step try_again(const Plan& plan, Visit visit, const std::string& why) {
  if (visit.disturbed + 1 >= plan.limits.dwell_attempts_max) {
    return with(point_failed(plan, visit, why), next_point(plan, visit));
  }
  ++visit.attempt;
  ++visit.disturbed;
  return go_to(plan, visit);
}

Action answer(const Fault& fault) {
  if (fault.hands_off) return HoldRamp{};
  return MakeSafe{};
}

/// States that are about a setpoint: what an operator may pause, skip and abort.
template <class S>
concept AtPoint = requires(const S& state) {
  state.visit;
};

struct OnEvent {
  const Plan& plan;

  // The way through a campaign.
  Step operator()(const Preflight&, const Ready& e) const { return go_to(plan, e.first); }
  Step operator()(const Preflight&, const NothingLeft&) const { return go_home(plan, false); }
  Step operator()(const Ramping& s, const AtSetpoint&) const { return {Soaking{s.visit}, {}}; }
  Step operator()(const Soaking& s, const Settled&) const {
    return {Logging{s.visit}, {BeginDwell{s.visit}}};
  }
  Step operator()(const Logging& s, const DwellDone&) const {
    return with(StoreDwell{}, next_point(plan, s.visit));
  }
  Step operator()(const Returning& s, const Restored&) const {
    if (s.aborting) return {Aborted{}, {}};
    return {Analysing{}, {Analyse{}}};
  }
  Step operator()(const Returning& s, const NotRestored& e) const {
    return with(Say{"warning", "not_restored", e.why}, (*this)(s, Restored{}));
  }
  Step operator()(const Analysing&, const Analysed& e) const { return {Finished{e.models}, {}}; }

  // What goes wrong and is lived with.
  Step operator()(const Soaking& s, const Unsettled& e) const {
    return with(point_failed(plan, s.visit, e.why), next_point(plan, s.visit));
  }
  Step operator()(const Logging& s, const DwellShort& e) const {
    return with(StoreDwell{}, try_again(plan, s.visit, e.why));
  }
  Step operator()(const Logging& s, const DwellDisturbed& e) const {
    return with(RejectDwell{e.why}, try_again(plan, s.visit, e.why));
  }
  Step operator()(const Ramping& s, const DeviceAway& e) const {
    return {Holding{s.visit, e.why}, {HoldRamp{}}};
  }
  Step operator()(const Soaking& s, const DeviceAway& e) const {
    return {Holding{s.visit, e.why}, {}};
  }
  Step operator()(const Logging& s, const DeviceAway& e) const {
    Visit again = s.visit;
    ++again.attempt;
    return {Holding{again, e.why}, {RejectDwell{e.why}}};
  }
  Step operator()(const Holding& s, const DeviceBack&) const { return go_to(plan, s.visit); }

  // What an operator asks for.
  Step operator()(const Ramping& s, const PauseAsked&) const {
    return {Paused{s.visit}, {HoldRamp{}}};
  }
  Step operator()(const Soaking& s, const PauseAsked&) const { return {Paused{s.visit}, {}}; }
  Step operator()(const Holding& s, const PauseAsked&) const { return {Paused{s.visit}, {}}; }
  Step operator()(const Logging& s, const PauseAsked&) const {
    Visit again = s.visit;
    ++again.attempt;
    return {Paused{again}, {RejectDwell{"paused by an operator"}}};
  }
  Step operator()(const Paused& s, const ResumeAsked&) const { return go_to(plan, s.visit); }
  Step operator()(const Logging& s, const SkipAsked&) const {
    return with(RejectDwell{skipped}, next_point(plan, s.visit));
  }
  template <AtPoint S>
  Step operator()(const S& s, const SkipAsked&) const {
    return with(NoteSkip{s.visit}, next_point(plan, s.visit));
  }
  Step operator()(const Preflight&, const AbortAsked&) const { return {Aborted{}, {}}; }
  Step operator()(const Logging&, const AbortAsked&) const {
    return with(RejectDwell{"aborted by an operator"}, go_home(plan, true));
  }
  template <AtPoint S>
  Step operator()(const S&, const AbortAsked&) const {
    return go_home(plan, true);
  }
  Step operator()(const Returning&, const AbortAsked&) const { return {Returning{true}, {}}; }

  // A fault stops everything but what has ended.
  Step operator()(const Logging&, const Fault& e) const {
    return {Safe{e.why}, {answer(e), RejectDwell{e.why}}};
  }
  template <class S>
  Step operator()(const S& s, const Fault& e) const {
    if constexpr (std::is_same_v<S, Finished> || std::is_same_v<S, Aborted> ||
                  std::is_same_v<S, Safe>) {
      return {s, {}};
    } else {
      return {Safe{e.why}, {answer(e)}};
    }
  }

  template <class S, class E>
  Step operator()(const S& s, const E&) const {
    return {s, {}};  // not awaited here
  }
};

}  // namespace

Step step(const Plan& plan, const State& state, const Event& event) {
  return std::visit(OnEvent{plan}, state, event);
}

const Visit* visit_of(const State& state) {
  return std::visit(
      [](const auto& s) -> const Visit* {
        if constexpr (AtPoint<std::decay_t<decltype(s)>>) {
          return &s.visit;
        } else {
          return nullptr;
        }
      },
      state);
}

bool ended(const State& state) { return has_ended(name(state)); }

const char* name(const State& state) {
  return std::visit(
      Overloaded{
          [](const Preflight&) { return "preflight"; }, [](const Ramping&) { return "ramping"; },
          [](const Soaking&) { return "soaking"; }, [](const Logging&) { return "logging"; },
          [](const Paused&) { return "paused"; }, [](const Holding&) { return "holding"; },
          [](const Returning&) { return "returning"; },
          [](const Analysing&) { return "analysing"; }, [](const Finished&) { return "finished"; },
          [](const Aborted&) { return "aborted"; }, [](const Safe&) { return "safe"; }},
      state);
}

const std::array<std::string_view, std::variant_size_v<State>>& state_names() {
  static const auto names = []<std::size_t... i>(std::index_sequence<i...>) {
    return std::array<std::string_view, sizeof...(i)>{name(State(std::in_place_index<i>))...};
  }
  (std::make_index_sequence<std::variant_size_v<State>>{});
  return names;
}

bool has_ended(std::string_view state_name) {
  for (const State& last : {State(Finished{}), State(Aborted{}), State(Safe{})}) {
    if (state_name == name(last)) return true;
  }
  return false;
}

std::string describe(const Plan& plan, const State& state) {
  std::string text = name(state);
  if (const Visit* visit = visit_of(state)) {
    text += fmt::format(" at {:.1f} degC (point {} of {}", target(plan, *visit).value,
                        visit->point + 1, plan.setpoints.size());
    text += visit->attempt > 1 ? fmt::format(", attempt {})", visit->attempt) : ")";
  }
  if (const auto* safe = std::get_if<Safe>(&state)) text += ": " + safe->why;
  if (const auto* holding = std::get_if<Holding>(&state)) text += ": " + holding->why;
  return text;
}

}  // namespace gyrocal::campaign
