#include <fmt/format.h>

#include "daemon/runner/analysis.h"
#include "tests/bench/analyse_file.h"
#include "tests/bench/python_peer.h"
#include "tests/bench/sample_campaign.h"
#include "tests/bench/scratch.h"
#include "tests/bench/sections.h"

namespace gyrocal::bench {
namespace {

Result<void> read_samples(const std::string& path) {
  const auto store = Store::open_read_only(path);
  if (!store) return tl::unexpected(store.error());
  const auto dwells = store->accepted_dwells(CampaignId{1}, BoardId{1});
  if (!dwells) return tl::unexpected(dwells.error());
  for (const AcceptedDwell& dwell : *dwells) {
    const auto samples = store->samples(dwell.id);
    if (!samples) return tl::unexpected(samples.error());
  }
  return {};
}

/// Largest difference between the fits that both made, over axes and setpoints.
std::string difference(const std::string& path, const nlohmann::json& peer) {
  const auto store = Store::open_read_only(path);
  if (!store) return store.error().what;
  double largest = 0;
  for (const Axis axis : all_axes) {
    const auto models = store->models(CampaignId{1}, BoardId{1}, axis);
    if (!models) return models.error().what;
    for (const ModelInsert& model : *models) {
      const auto& fits = peer.at(std::string(1, letter(axis)));
      if (!fits.contains(model.method)) continue;
      std::vector<double> ours;
      for (const ModelPoint& point : model.points) ours.push_back(point.fitted_dps);
      largest = std::max(
          largest, largest_difference(ours, fits.at(model.method).get<std::vector<double>>()));
    }
  }
  return fmt::format("differs by {:.1e}", largest);
}

/// The script, run a few times.
struct ScriptRuns {
  std::optional<Spread> cpu_s;
  std::optional<Spread> reading_s;
  nlohmann::json fits;
};
ScriptRuns run_script(const std::string& path) {
  std::vector<double> cpu_s;
  std::vector<double> reading_s;
  ScriptRuns runs;
  for (int i = 0; i < 3; ++i) {
    const auto ran = run_python("analysis_peer.py", {path});
    if (!ran) return runs;
    runs.fits = nlohmann::json::parse(ran->printed);
    cpu_s.push_back(ran->cpu_s);
    reading_s.push_back(runs.fits.at("reading_s"));
  }
  runs.cpu_s = spread_of(std::move(cpu_s));
  runs.reading_s = spread_of(std::move(reading_s));
  return runs;
}

std::optional<Spread> run_ours(const std::string& path) {
  std::vector<double> cpu_s;
  for (int i = 0; i < 9; ++i) {
    const auto ran = run_child({this_program(), "--analyse", path});
    if (!ran || ran->exit_code != 0) return std::nullopt;
    cpu_s.push_back(ran->cpu_s);
  }
  return spread_of(std::move(cpu_s));
}

/// CPU of the whole process, its helpers' included: from a closed file to stored models.
Result<Spread> from_file_to_models(const std::string& path) {
  const auto campaign = demo_campaign();
  if (!campaign) return tl::unexpected(campaign.error());
  std::vector<double> cpu_s;
  for (int i = 0; i < 15; ++i) {
    const double before = seconds_of(CLOCK_PROCESS_CPUTIME_ID);
    auto store = Store::open(path);
    if (!store) return tl::unexpected(store.error());
    const auto done = runner::analyse_campaign(*store, CampaignId{1}, *campaign, "bench");
    if (!done) return tl::unexpected(done.error());
    cpu_s.push_back(seconds_of(CLOCK_PROCESS_CPUTIME_ID) - before);
  }
  return spread_of(std::move(cpu_s));
}

Rows rows_for(const std::string& path) {
  const std::string job = "campaign of 75000 samples x 3 axes to models";
  const auto ours = run_ours(path);
  if (!ours) return {failed(job, "gyrocal_bench --analyse " + path)};
  const ScriptRuns script = run_script(path);
  const auto alone = from_file_to_models(path);
  if (!alone) return {failed(job, alone.error().what)};
  Rows rows{
      within(job, *alone, 0.040, "from a closed file to stored models"),
      against("the same, whole processes", *ours, {"Python script", script.cpu_s, "python3-pywt"},
              10, script.cpu_s ? difference(path, script.fits) : "nothing to compare with")};
  Result<void> read;
  const Spread reading = cpu_of_runs_s(9, [&] { read = read_samples(path); });
  rows.push_back(read ? against("reading its samples alone", reading,
                                {"Python sqlite3", script.reading_s, "python3-pywt"}, {}, "")
                      : failed("reading its samples alone", read.error().what));
  return rows;
}

}  // namespace

int analyse_file(const std::string& path) {
  const auto campaign = demo_campaign();
  auto store = Store::open(path);
  if (!campaign || !store) return 1;
  return runner::analyse_campaign(*store, CampaignId{1}, *campaign, "bench") ? 0 : 1;
}

Rows analysis_rows() {
  const Scratch folder;
  const std::string path = folder / "campaign.db";
  {
    auto store = Store::open(path);
    if (!store) return {failed("analysis", store.error().what)};
    const auto written = write_campaign(*store, {});
    if (!written) return {failed("analysis", written.error().what)};
  }
  return rows_for(path);
}

}  // namespace gyrocal::bench
