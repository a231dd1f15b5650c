#include "daemon/runner/run_request.h"

#include <algorithm>

#include "daemon/runner/after_trip.h"
#include "daemon/runner/control_socket.h"
#include "daemon/runner/device_lock.h"
#include "daemon/runner/disk_room.h"
#include "daemon/runner/link_layers.h"
#include "daemon/runner/owned_devices.h"
#include "daemon/runner/run_recording.h"
#include "drivers/clocks.h"

namespace gyrocal::runner {
namespace {

constexpr double turn_wall_s = 0.02;       ///< of the loop on real endpoints
constexpr double patience_wall_s = 5;      ///< for a first frame
constexpr double stop_within_wall_s = 8;   ///< systemd and a person both wait that long
constexpr double trip_within_wall_s = 50;  ///< then systemd starts it again

}  // namespace

RunOptions wired_options(const CampaignConfig& config) {
  RunOptions options;
  const double scale = config.time_scale;
  options.tick = std::min(seconds(turn_wall_s * scale), seconds(config.chamber.poll_interval_s));
  options.patience = seconds(patience_wall_s * scale);
  options.stop_within = seconds(stop_within_wall_s * scale);
  options.utc_rate = scale;
  return options;
}

RunOptions virtual_options(const CampaignConfig& config) {
  RunOptions options;
  options.tick = seconds(config.chamber.poll_interval_s);
  options.patience = seconds(patience_wall_s);
  options.stop_within = seconds(stop_within_wall_s);
  options.monitor_rows_per_write = 4096;  // no power cut in virtual time; a commit costs real time
  return options;
}

namespace {

/// A crash costs the recording a second of the machine's time; in virtual time nothing is at stake.
Duration flush_every(const CampaignConfig& config, bool in_virtual_time) {
  return in_virtual_time ? Duration::max() : seconds(config.time_scale);
}

/// How the database's campaign ended, if nobody is there to begin another or to re-arm this one.
Result<std::optional<Outcome>> left_alone(const Store& store, const RunRequest& request) {
  if (!request.unattended) return std::nullopt;
  auto latest = store.latest_campaign();
  if (!latest) return tl::unexpected(latest.error());
  if (!*latest) return std::nullopt;
  auto row = store.campaign(**latest);
  if (!row) return tl::unexpected(row.error());
  const auto as = [&](campaign::State state) { return Outcome{**latest, std::move(state)}; };
  if (row->state == campaign::name(campaign::Finished{})) return as(campaign::Finished{});
  if (row->state == campaign::name(campaign::Aborted{})) return as(campaign::Aborted{});
  if (row->state == campaign::name(campaign::Safe{})) {
    return as(campaign::Safe{"tripped before; 'gyrocal run --resume' re-arms it"});
  }
  return std::nullopt;
}

Result<Outcome> run_recorded(const CampaignConfig& config, OwnedDevices& owned, Store& store,
                             const RunOptions& options, const RunHooks& hooks) {
  Recorder* const recorder = owned.recorder();
  if (recorder == nullptr) return run_campaign(config, owned.devices(), store, options, hooks);
  auto outcome =
      run_campaign(config, owned.devices(), store, options, recorded_hooks(hooks, *recorder));
  recorder->input(input::ended, ended_text(outcome));
  return outcome;
}

/// What this run begins with, for its recording.
Result<RecordedRun> recorded_run(const CampaignConfig& config, const Store& store,
                                 const RunOptions& options, bool in_virtual_time,
                                 bool completes_trip = false) {
  Circumstances circumstances{
      options, in_virtual_time, config.chamber.profile.text, {}, completes_trip};
  auto open = options.resume ? store.open_campaign() : std::nullopt;
  if (!open) return tl::unexpected(open.error());
  if (*open) {
    circumstances.resumed = {static_cast<std::int64_t>((*open)->id), (*open)->campaign.state,
                             (*open)->t_last_ns};
  }
  RecordedRun run;
  run.started_utc_ns = ScaledClock().utc_ns();
  run.software_version = options.software_version;
  run.campaign_text = config.text;
  run.circumstances = to_json(circumstances);
  run.streams = link_names(config);
  return run;
}

/// Devices, with what only real ones need: a lock on the chamber and an ear for operators.
Result<Outcome> run_wired(const CampaignConfig& config, Store& store, const RunOptions& options,
                          RunHooks hooks, RunRecording* recording) {
  auto lock = lock_chamber(config.chamber);
  if (!lock) return tl::unexpected(lock.error());
  auto control = ControlSocket::open(control_path(config.name));
  if (!control) return tl::unexpected(control.error());
  hooks.next_command = [&] { return control->next_command(); };
  hooks.progress = [&, show = hooks.progress](const Snapshot& now) {
    control->serve(now);
    if (show) show(now);
  };
  const auto owned = wired_devices(config, recording ? recording->writer() : nullptr);
  return run_recorded(config, *owned, store, options, hooks);
}

Result<void> complete_recorded(const CampaignConfig& config, OwnedDevices& owned, Store& store,
                               const OpenCampaign& open, Duration within) {
  auto devices = owned.devices();
  Recorder* const recorder = owned.recorder();
  if (recorder) recorder->input(input::begun, begun_text(open.id, Duration{open.t_last_ns}));
  auto done = complete_trip(config, store, open.id, devices.chamber, devices.clock, within);
  if (recorder) recorder->input(input::ended, ended_text(done));
  return done;
}

/// For a campaign that has tripped, where nobody re-arms it: its daemon may have died before the
/// chamber could be told.
Result<void> complete_wired_trip(const CampaignConfig& config, Store& store, CampaignId campaign,
                                 const RunRequest& request, const std::string& database) {
  const auto left = after_trip(store, campaign);
  if (!left) return tl::unexpected(left.error());
  if (*left != AfterTrip::unconfirmed) return {};
  auto lock = lock_chamber(config.chamber);
  if (!lock) return tl::unexpected(lock.error());
  const auto open = store.open_campaign();
  if (!open) return tl::unexpected(open.error());
  if (!*open) return {};
  RunOptions options = wired_options(config);
  options.software_version = request.software_version;
  options.resume = true;
  options.stop_within = seconds(trip_within_wall_s * config.time_scale);
  const auto run = recorded_run(config, store, options, false, true);
  if (!run) return tl::unexpected(run.error());
  std::optional<RunRecording> recording;
  if (request.record.value_or(true)) recording.emplace(database, *run, flush_every(config, false));
  const auto owned = wired_devices(config, recording ? recording->writer() : nullptr);
  return complete_recorded(config, *owned, store, **open, options.stop_within);
}

}  // namespace

Result<Outcome> run_requested(
    const RunRequest& request, const RunHooks& hooks,
    const std::function<void(const Store&, CampaignId, const std::string& database)>& report) {
  auto config = read_campaign(request.campaign_path);
  if (!config) return tl::unexpected(config.error());
  if (request.virtual_rig && !config->simulated) {
    return fail(Errc::bad_input,
                request.campaign_path + ": its devices are real, they cannot run in virtual time",
                "set simulated = true in [campaign], or leave --virtual out");
  }
  const std::string path = request.database.value_or(config->database);
  auto store = Store::open(path);
  if (!store) return tl::unexpected(store.error());
  auto before = left_alone(*store, request);
  if (!before) return tl::unexpected(before.error());
  if (*before) {
    const bool tripped = std::holds_alternative<campaign::Safe>((*before)->state);
    if (!tripped || request.virtual_rig) return **before;
    auto done = complete_wired_trip(*config, *store, (*before)->campaign, request, path);
    if (!done) return tl::unexpected(done.error());
    return **before;
  }

  RunOptions options = request.virtual_rig ? virtual_options(*config) : wired_options(*config);
  options.software_version = request.software_version;
  options.resume = request.resume;
  RunHooks watched = hooks;
  watched.bytes_free = [&path] { return disk_room(path); };
  const bool in_virtual_time = request.virtual_rig.has_value();
  std::optional<RunRecording> recording;
  if (request.record.value_or(!in_virtual_time)) {
    auto run = recorded_run(*config, *store, options, in_virtual_time);
    if (!run) return tl::unexpected(run.error());
    recording.emplace(path, *run, flush_every(*config, in_virtual_time));
    watched.trouble = [&recording] { return recording->trouble(); };
  }
  auto outcome = [&] {
    RunRecording* const into = recording ? &*recording : nullptr;
    if (!in_virtual_time) return run_wired(*config, *store, options, watched, into);
    const auto owned = virtual_devices(*config, request.virtual_rig->model,
                                       request.virtual_rig->seed, into ? into->writer() : nullptr);
    return run_recorded(*config, *owned, *store, options, watched);
  }();
  const bool has_models = outcome && std::holds_alternative<campaign::Finished>(outcome->state);
  if (has_models) report(*store, outcome->campaign, path);
  return outcome;
}

}  // namespace gyrocal::runner
