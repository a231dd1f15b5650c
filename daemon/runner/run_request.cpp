#include "daemon/runner/run_request.h"

#include <algorithm>

#include "daemon/runner/control_socket.h"
#include "daemon/runner/device_lock.h"
#include "daemon/runner/owned_devices.h"

namespace gyrocal::runner {
namespace {

constexpr double turn_wall_s = 0.02;      ///< of the loop on real endpoints
constexpr double patience_wall_s = 5;     ///< for a first frame
constexpr double stop_within_wall_s = 8;  ///< systemd and a person both wait that long

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

/// Devices, with what only real ones need: a lock on the chamber and an ear for operators.
Result<Outcome> run_wired(const CampaignConfig& config, Store& store, const RunOptions& options,
                          RunHooks hooks) {
  auto lock = lock_chamber(config.chamber);
  if (!lock) return tl::unexpected(lock.error());
  auto control = ControlSocket::open(control_path(config.name));
  if (!control) return tl::unexpected(control.error());
  hooks.next_command = [&] { return control->next_command(); };
  hooks.progress = [&, show = hooks.progress](const Snapshot& now) {
    control->serve(now);
    if (show) show(now);
  };
  const auto owned = wired_devices(config);
  return run_campaign(config, owned->devices(), store, options, hooks);
}

}  // namespace

Result<Outcome> run_requested(
    const RunRequest& request, const RunHooks& hooks,
    const std::function<void(const Store&, CampaignId, const std::string& database)>& report) {
  auto config = read_campaign(request.campaign_path);
  if (!config) return tl::unexpected(config.error());
  if (request.virtual_seed && !config->simulated) {
    return fail(Errc::bad_input,
                request.campaign_path + ": its devices are real, they cannot run in virtual time",
                "set simulated = true in [campaign], or leave --virtual out");
  }
  const std::string path = request.database.value_or(config->database);
  auto store = Store::open(path);
  if (!store) return tl::unexpected(store.error());
  auto before = left_alone(*store, request);
  if (!before) return tl::unexpected(before.error());
  if (*before) return **before;

  RunOptions options = request.virtual_seed ? virtual_options(*config) : wired_options(*config);
  options.software_version = request.software_version;
  options.database = path;
  options.resume = request.resume;
  auto outcome = [&] {
    if (!request.virtual_seed) return run_wired(*config, *store, options, hooks);
    const auto owned = virtual_devices(*config, rig::RigModel{}, *request.virtual_seed);
    return run_campaign(*config, owned->devices(), *store, options, hooks);
  }();
  const bool has_models = outcome && std::holds_alternative<campaign::Finished>(outcome->state);
  if (has_models) report(*store, outcome->campaign, path);
  return outcome;
}

}  // namespace gyrocal::runner
