#include "daemon/runner/campaign_loop.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "compensation/values/assert.h"
#include "daemon/campaign/overloaded.h"
#include "daemon/runner/analysis.h"

namespace gyrocal::runner {
namespace {

using campaign::Presence;

constexpr int polls_before_unknown = 3;
constexpr Duration doubt_told_every = std::chrono::minutes{10};
constexpr double machine_look_every_utc_s = 60;

/// Readings older than this prove nothing about stability.
Duration unknown_after(const campaign::Plan& plan, Duration tick) {
  return polls_before_unknown * std::max(plan.poll_interval, tick);
}

}  // namespace

CampaignLoop::CampaignLoop(const CampaignConfig& config, const campaign::Plan& plan,
                           Devices& devices, const Found& found, Store& store,
                           const RunOptions& options, const RunHooks& hooks, Begin begin)
    : config_(config),
      plan_(plan),
      devices_(devices),
      store_(store),
      options_(options),
      hooks_(hooks),
      begin_(std::move(begin)),
      journal_(store, begin_.campaign, devices.clock, hooks.log, hooks.storing,
               options.monitor_rows_per_write),
      chamber_(devices.chamber, plan, found.chamber, begin_.t),
      track_(std::max(unknown_after(plan, options.tick), air_is_straight_over),
             seconds(plan.limits.chamber_stale_s)),
      conditions_(plan, unknown_after(plan, options.tick)),
      supervisor_(plan.allowed),
      collector_(plan.samples_per_dwell, plan.limits.frames_lost_share_max),
      machine_(options.utc_rate) {
  conditions_.air(begin_.t, found.chamber.actual);
  const BoardMode mode{plan.sample_rate_hz, false, true};
  for (std::size_t i = 0; i < begin_.boards.size(); ++i) {
    boards_.push_back({begin_.boards[i],
                       BoardPort(*devices.boards[i], found.boards[i], mode,
                                 seconds(plan.limits.board_stale_s), begin_.t),
                       SlowStream(monitor_interval, begin_.t)});
    if (found.away[i]) boards_.back().port.missed(begin_.t, to_text(*found.away[i]));
  }
}

Result<Outcome> CampaignLoop::run() {
  Result<void> done;
  if (!begin_.resumed.empty()) {
    done = journal_.event(begin_.t, "info", "resumed", "resumed " + begin_.resumed);
  }
  if (done) done = feed(begin_.first);
  bool stopped = false;
  while (done && !campaign::ended(state_)) {
    if (hooks_.stop_asked && hooks_.stop_asked()) {
      stopped = true;
      done = stop();
      break;
    }
    done = turn();
  }
  if (done && std::holds_alternative<campaign::Safe>(state_)) done = reach_safety();
  if (done) done = journal_.flush();
  if (!done) {
    // Without a database there is nothing to run for; the chamber must not stay where it is.
    chamber_.make_safe();
    static_cast<void>(chamber_.drive(now()));
  }
  for (auto& board : boards_) board.port.stop();
  if (!done) return tl::unexpected(done.error());
  return Outcome{begin_.campaign, state_, stopped};
}

Result<void> CampaignLoop::turn() {
  const Instant began = devices_.clock.now();
  auto done = read_boards();
  if (done) done = read_chamber();
  if (done) done = judge();
  if (done) done = drive_chamber();
  if (done) done = write_slow_stream();
  if (done) done = watch_machine();
  if (!done) return done;
  if (hooks_.progress) hooks_.progress(snapshot());
  if (!campaign::ended(state_)) devices_.clock.sleep_until(began + options_.tick);
  return {};
}

Result<void> CampaignLoop::read_boards() {
  for (std::size_t i = 0; i < boards_.size(); ++i) {
    fresh_.clear();
    boards_[i].port.poll(now(), fresh_);
    for (auto& sample : fresh_) sample.t_ns -= begin_.origin.time_since_epoch().count();
    collector_.add(i, fresh_);
    boards_[i].slow.add(fresh_);
    if (auto noted = note_presence(i); !noted) return noted;
  }
  return {};
}

Result<void> CampaignLoop::note_presence(std::size_t board) {
  BoardSide& side = boards_[board];
  const Duration t = now();
  Presence seen = Presence::expected;
  if (const auto since = side.port.away_since()) {
    const bool too_long = t - *since > seconds(plan_.limits.board_away_s_max);
    seen = too_long ? Presence::given_up : Presence::away;
  }
  if (seen == side.presence) return {};
  const Presence before = std::exchange(side.presence, seen);
  conditions_.presence(board, seen);
  const std::string& name = plan_.boards[board];
  if (seen == Presence::expected) {
    return journal_.event(t, "info", "board_back", fmt::format("board {} streams again", name));
  }
  if (seen == Presence::given_up && before == Presence::away) {
    return journal_.event(t, "error", "board_given_up",
                          fmt::format("board {} has been away for {:.0f} min; the campaign goes on "
                                      "without it until it returns",
                                      name, plan_.limits.board_away_s_max / 60));
  }
  collector_.spoil(board, "the board went away");
  return journal_.event(t, "warning", "board_lost",
                        fmt::format("board {}: {}", name, side.port.trouble()));
}

Result<void> CampaignLoop::read_chamber() {
  const Duration t = now();
  if (!chamber_.due(t)) return {};
  if (const auto reading = chamber_.poll(t)) {
    conditions_.air(t, reading->actual);
    for (auto& board : boards_) board.freeze.air(reading->actual);
    track_.observe(t, reading->actual, reading->setpoint);
    if (const auto trip = supervisor_.look(t, *reading, chamber_.commanded())) {
      if (auto fed = feed(campaign::Fault{trip->why, trip->hands_off}); !fed) return fed;
    }
  }
  if (auto noted = note_doubt(); !noted) return noted;
  if (chamber_.away() == chamber_was_away_) return {};
  chamber_was_away_ = chamber_.away();
  if (!chamber_was_away_) {
    return journal_.event(t, "info", "chamber_back", "the chamber answers again");
  }
  return journal_.event(t, "warning", "chamber_lost", chamber_.trouble());
}

Result<void> CampaignLoop::note_doubt() {
  const int doubtful = chamber_.doubtful_readings();
  if (doubtful == doubtful_told_) return {};
  const Duration t = now();
  const bool told_lately = doubt_told_ != Duration::min() && t - doubt_told_ < doubt_told_every;
  if (told_lately) return {};
  const int more = doubtful - std::exchange(doubtful_told_, doubtful);
  doubt_told_ = t;
  return journal_.event(t, "warning", "doubtful_reading",
                        fmt::format("{} readings of the chamber that none can have meant (a lone "
                                    "0.0, a jump over 20 K) were left out",
                                    more));
}

Result<void> CampaignLoop::watch_machine() {
  const Duration t = now();
  if (const auto trouble = hooks_.trouble ? hooks_.trouble() : std::nullopt) {
    auto told = journal_.event(t, "warning", "not_recorded",
                               "the campaign goes on without a recording: " + to_text(*trouble));
    if (!told) return told;
  }
  if (t < next_machine_look_) return {};
  next_machine_look_ = t + seconds(machine_look_every_utc_s * options_.utc_rate);
  const auto known = hooks_.bytes_free ? hooks_.bytes_free() : std::nullopt;
  const auto free = known.value_or(UINTMAX_MAX);
  for (const auto& notice : machine_.look(t, devices_.clock.utc_ns(), free)) {
    if (auto done = journal_.event(t, notice.severity, notice.kind, notice.text); !done)
      return done;
    if (notice.slept) {
      if (auto done = feed(campaign::DwellDisturbed{notice.text}); !done) return done;
    }
    if (notice.disk_full) {
      if (auto done = feed(campaign::Fault{notice.text}); !done) return done;
    }
  }
  return {};
}

Result<void> CampaignLoop::drive_chamber() {
  auto driven = chamber_.drive(now());
  if (driven || std::holds_alternative<campaign::Safe>(state_)) return {};
  const bool another_master = driven.error().code == Errc::mismatch;
  return feed(campaign::Fault{to_text(driven.error()), another_master});
}

Result<void> CampaignLoop::judge() {
  if (hooks_.next_command) {
    while (auto command = hooks_.next_command()) {
      if (auto fed = feed(*command); !fed) return fed;
    }
  }
  const Duration t = now();
  if (chamber_.age(t) > seconds(plan_.limits.chamber_stale_s)) {
    return feed(campaign::Fault{fmt::format("no reading of the chamber for {:.0f} s: {}",
                                            to_seconds(chamber_.age(t)), chamber_.trouble())});
  }
  if (auto event = presence_event()) return feed(*event);
  conditions_.commanded(chamber_.commanded());
  if (auto event = conditions_.due(state_, t)) return feed(*event);
  if (auto event = dwell_event()) return feed(*event);
  return {};
}

std::optional<campaign::Event> CampaignLoop::presence_event() const {
  const bool all_gone = std::all_of(boards_.begin(), boards_.end(), [](const BoardSide& b) {
    return b.presence == Presence::given_up;
  });
  if (all_gone) return campaign::Fault{"every board has been given up"};
  const bool waiting = std::any_of(boards_.begin(), boards_.end(),
                                   [](const BoardSide& b) { return b.presence == Presence::away; });
  if (std::holds_alternative<campaign::Holding>(state_)) {
    if (!chamber_.away() && !waiting) return campaign::DeviceBack{};
    return std::nullopt;
  }
  if (chamber_.away()) return campaign::DeviceAway{"the chamber is away"};
  return std::nullopt;
}

std::optional<campaign::Event> CampaignLoop::dwell_event() {
  if (!collector_.full()) return std::nullopt;
  // A process that was stopped finds the boards' frames waiting, but not the chamber's readings.
  collector_.look_back([&](Duration from, Duration to) -> std::optional<std::string> {
    if (track_.dwell_mean(from, to)) return std::nullopt;
    return fmt::format("the chamber's temperature is not known: no reading for over {:.0f} s",
                       to_seconds(track_.dwell_gap_max()));
  });
  if (const auto shortfall = collector_.shortfall()) {
    return campaign::DwellShort{
        fmt::format("board {}: {}", plan_.boards[shortfall->board], shortfall->reason)};
  }
  return campaign::DwellDone{};
}

Result<void> CampaignLoop::feed(const campaign::Event& event) {
  const auto* const fault = std::get_if<campaign::Fault>(&event);
  if (fault && fault->hands_off && !campaign::ended(state_)) {
    // Before the trip itself: whoever is started after a crash must know.
    auto told = journal_.event(now(), "error", "hands_off",
                               "the chamber is left as it is; look after it: " + fault->why);
    if (!told) return told;
  }
  campaign::Step step = campaign::step(plan_, state_, event);
  const std::string before = campaign::describe(plan_, state_);
  const char* const left = campaign::name(state_);
  const std::string after = campaign::describe(plan_, step.next);
  const campaign::State was = std::exchange(state_, std::move(step.next));
  if (const auto* visit = campaign::visit_of(state_)) reached_ = visit->point;
  if (before != after) {
    note_pace(was);
    entered_ = now();
    conditions_.entered(state_, entered_);
    auto noted =
        journal_.transition(entered_, campaign::name(state_), fmt::format("{} -> {}", left, after));
    if (!noted) return noted;
  }
  for (const auto& action : step.actions) {
    if (auto done = act(action); !done) return done;
  }
  return {};
}

Result<void> CampaignLoop::act(const campaign::Action& action) {
  using namespace campaign;
  return std::visit(
      Overloaded{[&](const RampTo& a) -> Result<void> {
                   chamber_.ramp_to(now(), a.target);
                   supervisor_.sent_to(a.target);
                   return {};
                 },
                 [&](const HoldRamp&) -> Result<void> {
                   chamber_.hold();
                   return {};
                 },
                 [&](const MakeSafe&) -> Result<void> {
                   chamber_.make_safe();
                   supervisor_.sent_to(plan_.safe);
                   return {};
                 },
                 [&](const BeginDwell& a) -> Result<void> {
                   begin_dwell(a.visit);
                   return {};
                 },
                 [&](const StoreDwell&) { return store_dwell(std::nullopt); },
                 [&](const RejectDwell& a) { return store_dwell(a.reason); },
                 [&](const NoteSkip& a) { return store_skip(a.visit); },
                 [&](const Analyse&) { return analyse(); },
                 [&](const Say& a) { return journal_.event(now(), a.severity, a.kind, a.text); }},
      action);
}

void CampaignLoop::begin_dwell(const campaign::Visit& visit) {
  dwell_visit_ = visit;
  read_frozen_temperatures();
  std::vector<std::size_t> wanted;
  for (std::size_t i = 0; i < boards_.size(); ++i) {
    if (boards_[i].presence == Presence::expected && !begin_.accepted[visit.point][i]) {
      wanted.push_back(i);
    }
  }
  for (std::size_t i = 0; i < boards_.size(); ++i) boards_[i].soak = conditions_.soak(i);
  collector_.begin(now(), wanted);
}

DwellRow CampaignLoop::row_of(const CollectedDwell& dwell) const {
  DwellRow row;
  row.board = boards_[dwell.board].id;
  row.ordinal = static_cast<int>(dwell_visit_.point);
  row.attempt = dwell_visit_.attempt;
  row.t_start_ns = dwell.samples.empty() ? collector_.began().count() : dwell.samples.front().t_ns;
  row.t_end_ns = dwell.samples.empty() ? now().count() : dwell.samples.back().t_ns;
  const campaign::Soak& soak = boards_[dwell.board].soak;
  row.soak_s = to_seconds(soak.in_band);
  row.timed_soak = soak.timed;
  const Duration from{row.t_start_ns};
  const Duration to{row.t_end_ns};
  row.chamber_mean_c = track_.dwell_mean(from, to).value_or(Celsius{missing}).value;
  row.chamber_peak_to_peak_k = track_.peak_to_peak(from, to).value_or(Kelvin{missing}).value;
  row.board_mean_c =
      std::isnan(dwell.board_mean_c) ? boards_[dwell.board].break_c : dwell.board_mean_c;
  row.frames_missing = dwell.frames_missing;
  row.reject_reason = dwell.reject_reason;
  return row;
}

Result<void> CampaignLoop::store_dwell(const std::optional<std::string>& reject_reason) {
  const auto group = collector_.finish(reject_reason);
  std::vector<DwellWithSamples> rows;
  for (const auto& dwell : group) rows.push_back({row_of(dwell), dwell.samples});
  if (rows.empty()) return {};
  if (auto stored = journal_.group(rows); !stored) return tl::unexpected(stored.error());
  for (const auto& dwell : group) {
    if (!dwell.reject_reason) begin_.accepted[dwell_visit_.point][dwell.board] = true;
  }
  return {};
}

Result<void> CampaignLoop::store_skip(const campaign::Visit& visit) {
  std::vector<DwellWithSamples> rows;
  for (std::size_t i = 0; i < boards_.size(); ++i) {
    if (begin_.accepted[visit.point][i]) continue;
    DwellRow row;
    row.board = boards_[i].id;
    row.ordinal = static_cast<int>(visit.point);
    row.attempt = visit.attempt;
    row.t_start_ns = now().count();
    row.t_end_ns = row.t_start_ns;
    row.reject_reason = campaign::skipped;
    rows.push_back({row, {}});
  }
  if (rows.empty()) return {};
  auto stored = journal_.group(rows);
  return stored ? Result<void>{} : tl::unexpected(stored.error());
}

Result<void> CampaignLoop::analyse() {
  if (auto flushed = journal_.flush(); !flushed) return flushed;
  if (auto may = journal_.may_store(); !may) return may;
  auto done = analyse_campaign(store_, begin_.campaign, config_, options_.software_version);
  if (done) return feed(campaign::Analysed{true});
  if (done.error().code == Errc::storage || done.error().code == Errc::busy) {
    return journal_.noted(std::move(done));
  }
  if (auto said = journal_.event(now(), "error", "no_model", to_text(done.error())); !said) {
    return said;
  }
  return feed(campaign::Analysed{false});
}

}  // namespace gyrocal::runner
