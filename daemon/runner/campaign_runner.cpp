#include "daemon/runner/campaign_runner.h"

#include <fmt/core.h>

#include "daemon/runner/analysis.h"
#include "daemon/runner/begin.h"

namespace gyrocal::runner {
namespace {

using KnownBoard = std::pair<BoardId, BoardRow>;

/// Whether what the database holds lets this campaign run, and as what.
Result<std::optional<OpenCampaign>> what_stands(const Store& store, const RunOptions& options) {
  auto open = store.open_campaign();
  if (!open || !*open) return open;
  const CampaignRow& row = (*open)->campaign;
  if (!options.resume) {
    return fail(Errc::busy,
                fmt::format("the database holds campaign '{}', which has not ended ({})", row.name,
                            row.state),
                "go on with it by --resume, or take another database by --db");
  }
  return open;
}

}  // namespace

Result<Outcome> run_campaign(const CampaignConfig& config, Devices devices, Store& store,
                             const RunOptions& options, const RunHooks& hooks) {
  auto plan = campaign::make_plan(config);
  if (!plan) return tl::unexpected(plan.error());
  if (auto filter = denoise_settings(config.analysis); !filter) {
    return tl::unexpected(filter.error());  // found out now, not after fifteen hours
  }
  auto open = what_stands(store, options);
  if (!open) return tl::unexpected(open.error());
  auto found = preflight(config, devices, options.patience,
                         *open ? std::span((*open)->boards) : std::span<const KnownBoard>());
  if (!found) return tl::unexpected(found.error());
  auto begin = *open ? begin_again(config, *found, devices.clock, store, **open)
                     : begin_new(config, *found, devices.clock, store, options.software_version);
  if (!begin) return tl::unexpected(begin.error());
  if (hooks.begun) hooks.begun(begin->campaign, begin->t);
  return CampaignLoop(config, *plan, devices, *found, store, options, hooks, *begin).run();
}

}  // namespace gyrocal::runner
