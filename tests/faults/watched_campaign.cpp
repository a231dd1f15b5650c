#include "tests/faults/watched_campaign.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "daemon/campaign/plan.h"
#include "daemon/runner/after_trip.h"
#include "daemon/runner/make_safe.h"
#include "daemon/runner/run_request.h"
#include "drivers/chamber/register_value.h"

namespace gyrocal::faults {
namespace {

constexpr std::size_t tty_buffer_bytes = 20480;  // measured on Linux
constexpr std::uintmax_t disk_empty = 80'000'000'000;
constexpr double restart_s = 2;  // the unit's RestartSec
constexpr Duration make_safe_within = std::chrono::seconds{50};
constexpr int failed_starts_max = 200;

CampaignConfig parsed(const std::string& text) {
  auto config =
      parse_campaign(text, std::string(GYROCAL_SOURCE_DIR) + "/config/campaigns/faults.toml");
  if (!config) throw Broken{to_text(config.error())};
  return *std::move(config);
}

bool spoils_wire(const RigFault& fault) {
  using Kind = RigFaultKind;
  switch (fault.kind) {
    case Kind::refuse:
    case Kind::late:
    case Kind::lost:
    case Kind::half:
    case Kind::exception:
    case Kind::wrong_unit:
    case Kind::wrong_register:
    case Kind::dead:
      return true;
    default:
      return false;
  }
}

bool lies(const RigFault& fault) {
  using Kind = RigFaultKind;
  return fault.kind == Kind::wrong_register || fault.kind == Kind::wrong_value ||
         fault.kind == Kind::spurious_zero || fault.kind == Kind::stuck;
}

/// The unit does not, after exit code 2: a wrong campaign file stays wrong.
bool started_again_after(Errc code) {
  return code != Errc::bad_input && code != Errc::unknown_name && code != Errc::out_of_range &&
         code != Errc::not_finite && code != Errc::too_few_points;
}

bool is_about_a_point(const std::string& state) {
  return state == "ramping" || state == "soaking" || state == "logging";
}

}  // namespace

WatchedCampaign::WatchedCampaign(const Schedule& schedule, std::uint64_t seed, std::string database,
                                 Checks& checks)
    : schedule_(schedule),
      database_(std::move(database)),
      checks_(checks),
      config_(parsed(schedule.campaign)),
      host_(world_),
      rig_(schedule.model, seed, config_.boards.size(), config_.chamber.profile,
           config_.chamber.unit, tty_buffer_bytes),
      bytes_free_(disk_empty),
      journal_(checks),
      acknowledged_(checks) {
  for (const PlannedFault& planned : schedule.faults) {
    if (planned.when.state.empty()) {
      world_.at(Instant{seconds(planned.when.after_s)}, [this, &planned] { begin(planned); });
    } else {
      awaited_.push_back(planned);
    }
  }
}

void WatchedCampaign::await_triggers(const runner::Snapshot& now) {
  for (std::size_t i = 0; i < awaited_.size();) {
    const Trigger& when = awaited_[i].when;
    const bool there = !is_about_a_point(now.state) ||
                       now.setpoints_done == when.point % config_.plan.setpoints.size();
    if (now.state != when.state || !there) {
      ++i;
      continue;
    }
    world_.at(world_.now() + seconds(when.after_s),
              [this, planned = awaited_[i]] { begin(planned); });
    awaited_.erase(awaited_.begin() + static_cast<std::ptrdiff_t>(i));
  }
}

void WatchedCampaign::begin(const PlannedFault& planned) {
  ++faults_begun_;
  if (const auto* rig = std::get_if<RigFault>(&planned.fault)) return begin_rig(*rig);
  begin_host(std::get<HostFault>(planned.fault));
}

void WatchedCampaign::begin_rig(RigFault fault) {
  fault.at_s = to_seconds(world_.now().time_since_epoch());
  const bool wire = spoils_wire(fault);
  wire_faults_ += wire;
  lies_ += lies(fault);
  excused_ = excused_ || wire;
  panel_touched_ = panel_touched_ || fault.kind == RigFaultKind::panel_setpoint;
  if (fault.board) {
    rig_.board(*fault.board).begin(fault, world_.now());
  } else {
    rig_.chamber().begin(fault, world_.now());
  }
  if (fault.for_s <= 0) return;
  world_.at(world_.now() + seconds(fault.for_s), [this, fault, wire] {
    wire_faults_ -= wire;
    lies_ -= lies(fault);
    if (fault.board) {
      rig_.board(*fault.board).end(fault, world_.now());
    } else {
      rig_.chamber().end(fault);
    }
  });
}

void WatchedCampaign::begin_host(const HostFault& fault) {
  using Kind = HostFaultKind;
  const auto later = [&](auto deed) { world_.at(world_.now() + seconds(fault.for_s), deed); };
  excused_ = true;
  switch (fault.kind) {
    case Kind::stopped:
      return rest(fault.for_s);
    case Kind::slept:
      return host_.sleep_machine(seconds(fault.for_s));
    case Kind::clock_step:
      return host_.step_utc(fault.value);
    case Kind::disk_little:
    case Kind::disk_full:
      bytes_free_ = fault.kind == Kind::disk_full ? 10'000'000 : 50'000'000;
      return later([this] { bytes_free_ = disk_empty; });
    case Kind::crash:
    case Kind::power_cut:
      power_gone_ = fault.kind == Kind::power_cut;
      restart_after_s_ = fault.for_s;
      return host_.crash_after(1 + static_cast<int>(fault.value));
    case Kind::pause:
      commands_.push_back(campaign::PauseAsked{});
      return later([this] { commands_.push_back(campaign::ResumeAsked{}); });
    case Kind::skip:
      commands_.push_back(campaign::SkipAsked{});
      return;
    case Kind::abort:
      commands_.push_back(campaign::AbortAsked{});
      return;
    case Kind::sigterm:
      stop_asked_ = true;
      restart_after_s_ = fault.for_s;
  }
}

Result<runner::Outcome> WatchedCampaign::daemon(Drivers& drivers, Store& store) {
  runner::RunOptions options = runner::virtual_options(config_);
  options.tick = schedule_.tick;
  options.software_version = "test";
  options.resume = true;
  options.monitor_rows_per_write = 24;
  runner::RunHooks hooks;
  hooks.bytes_free = [this] { return bytes_free_; };
  hooks.stop_asked = [this] { return stop_asked_; };
  hooks.next_command = [this]() -> std::optional<campaign::Event> {
    if (commands_.empty()) return std::nullopt;
    const auto command = commands_.front();
    commands_.pop_front();
    return command;
  };
  hooks.log = [this](const EventInsert& event) { told(event); };
  hooks.progress = [&](const runner::Snapshot& now) { seen(now, store); };
  return runner::run_campaign(config_, {host_, drivers.chamber(), drivers.boards()}, store, options,
                              hooks);
}

/// How the database's campaign has ended, if it has.
std::optional<std::string> WatchedCampaign::ended_before(const Store& store) const {
  const auto campaign = store.latest_campaign();
  if (!campaign || !*campaign) return std::nullopt;
  const auto row = store.campaign(**campaign);
  if (!row) throw Broken{to_text(row.error())};
  const bool ended = row->state == "finished" || row->state == "aborted" || row->state == "safe";
  return ended ? std::optional(row->state) : std::nullopt;
}

/// What gyrocald does with a campaign that has ended or tripped: leave it, but see to the chamber.
std::optional<std::string> WatchedCampaign::left_alone(const std::string& state, Store& store) {
  log_.push_back("left alone: " + state);
  if (state != "safe") return state;
  Drivers drivers(config_, rig_, world_, host_,
                  [this](const modbus::Request& request) { wrote(request); });
  const auto done = runner::complete_trip(config_, store, **store.latest_campaign(),
                                          drivers.chamber(), host_, make_safe_within);
  if (done) return state;
  log_.push_back(": not_safe: " + to_text(done.error()));  // in the journal, and started again
  return ++failed_starts_ < failed_starts_max ? std::nullopt : std::optional(state);
}

std::optional<std::string> WatchedCampaign::one_process() {
  journal_.process_began(world_.now());
  auto store = Store::open(database_);
  if (!store)
    throw Broken{"the database is opened after whatever happened: " + to_text(store.error())};
  acknowledged_.look(*store);
  if (const auto state = ended_before(*store)) return left_alone(*state, *store);
  Drivers drivers(config_, rig_, world_, host_,
                  [this](const modbus::Request& request) { wrote(request); });
  const auto outcome = daemon(drivers, *store);
  host_.not_crashing();
  acknowledged_.look(*store);
  if (!outcome) {
    log_.push_back("the daemon ends: " + to_text(outcome.error()));
    checks_.require(started_again_after(outcome.error().code), "systemd starts it again",
                    log_.back());
    if (++failed_starts_ < failed_starts_max) return std::nullopt;
    checks_.require(!schedule_.faults.empty(), "it begins where nothing is wrong", log_.back());
    return "never began";
  }
  if (outcome->stopped) return std::nullopt;
  return campaign::name(outcome->state);
}

void WatchedCampaign::make_safe() {
  Drivers drivers(config_, rig_, world_, host_,
                  [this](const modbus::Request& request) { wrote(request); });
  try {
    const auto done =
        runner::make_chamber_safe(config_, drivers.chamber(), host_, make_safe_within);
    if (!done) log_.push_back("make-safe: " + to_text(done.error()));
  } catch (const Crashed&) {  // killed too; the next daemon does its work
    ++crashes_;
    log_.push_back("make-safe: killed");
  }
}

void WatchedCampaign::close_ports() {
  for (std::size_t i = 0; i < rig_.board_count(); ++i) rig_.board(i).host_closes(world_.now());
}

std::string WatchedCampaign::run() {
  for (;;) {
    std::optional<std::string> ending;
    bool safe_needed = true;
    try {
      ending = one_process();
    } catch (const Crashed&) {
      ++crashes_;
      log_.push_back(fmt::format("{:.1f} s: killed", to_seconds(world_.now().time_since_epoch())));
      safe_needed = !std::exchange(power_gone_, false);
    } catch (const Hung&) {
      throw Broken{"it ends: still " + state_};
    }
    close_ports();
    stop_asked_ = false;
    if (ending) {
      if (*ending != "never began") check_end(*ending);
      return *ending;
    }
    if (safe_needed && !hands_off_) make_safe();
    rest(std::exchange(restart_after_s_, restart_s));
  }
}

}  // namespace gyrocal::faults
