#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "daemon/campaign/plan.h"
#include "drivers/chamber/register_value.h"
#include "tests/faults/watched_campaign.h"

namespace gyrocal::faults {
namespace {

constexpr Duration safe_within = std::chrono::seconds{10};
constexpr Kelvin opened_band{2.5};

}  // namespace

void WatchedCampaign::wrote(const modbus::Request& request) {
  const ChamberProfile& profile = config_.chamber.profile;
  checks_.require(!hands_off_, "hands off somebody else's chamber", modbus::to_text(request));
  const bool known = request.address == profile.temperature_setpoint.address ||
                     request.address == profile.run_state->reg.address ||
                     request.address == profile.run_type->reg.address;
  checks_.require(known, "only setpoint, run state and run type are written",
                  modbus::to_text(request));
  if (request.address != profile.temperature_setpoint.address) return;
  const double to_c = decode_value(profile.temperature_setpoint, request.values).value_or(1e9);
  const auto allowed = allowed_setpoints(config_);
  checks_.require(to_c >= allowed.min.value && to_c <= allowed.max.value,
                  "a setpoint within what boards and chamber allow", fmt::format("{}", to_c));
  panel_touched_ = false;
  if (!trip_ || to_c != config_.plan.safe_setpoint.value) return;
  const auto took = world_.now() - *std::exchange(trip_, std::nullopt);
  checks_.require(excused_ || took <= safe_within, "the safe setpoint is sent within 10 s",
                  fmt::format("{} s", to_seconds(took)));
}

void WatchedCampaign::told(const EventInsert& event) {
  const bool is_alarm =
      event.severity != "info" && event.kind != "no_model";  // a plan may hold too little
  alarms_ += is_alarm;
  host_.step();
  log_.push_back(
      fmt::format("{:.1f} s: {}: {}", double(event.t_ns) * 1e-9, event.kind, event.text));
  journal_.told(event, world_.now());
  if (!hands_off_ && event.text.find("-> safe") != std::string::npos) {
    trip_ = world_.now();
    excused_ = wire_faults_ > 0;
  }
  if (event.kind != "hands_off") return;
  hands_off_ = true;
  trip_.reset();
}

void WatchedCampaign::seen(const runner::Snapshot& now, const Store& store) {
  host_.step();
  if (state_ == "logging" && now.state != "logging") acknowledged_.look(store);
  state_ = now.state;
  if (state_ == "logging" && lies_ == 0) {
    true_air_.push_back({now.t, rig_.chamber().actual(world_.now())});
  }
  await_triggers(now);
}

void WatchedCampaign::check_end(const std::string& state) {
  check_database(database_, state, config_.limits.dwell_band, true_air_, checks_);
  const auto said = [&](const std::string& kind) {
    return std::any_of(log_.begin(), log_.end(), [&](const std::string& line) {
      return line.find(": " + kind + ": ") != std::string::npos;
    });
  };
  if (schedule_.faults.empty()) {
    checks_.require(state == "finished", "a campaign finishes where nothing goes wrong", state);
    checks_.require(dwells() == config_.plan.setpoints.size() * config_.boards.size(),
                    "and logs every setpoint of every board");
  }
  if (hands_off_ || panel_touched_) return;
  checks_.require(rig_.chamber().setpoint() == config_.plan.safe_setpoint || said("not_safe"),
                  "the chamber is left at its safe setpoint, or a person is told",
                  fmt::format("{}", rig_.chamber().setpoint().value));
  checks_.require(!trip_ || said("not_safe"), "a trip is followed by the safe setpoint");
  if (state == "safe" || lies_ > 0) return;
  const double off_k =
      std::abs((rig_.chamber().actual(world_.now()) - config_.plan.safe_setpoint).value);
  checks_.require(off_k <= opened_band.value || said("not_restored"), "a cold campaign ends warm",
                  fmt::format("{:.1f} K off", off_k));
}

}  // namespace gyrocal::faults
