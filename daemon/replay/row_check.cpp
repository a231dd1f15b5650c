#include "daemon/replay/row_check.h"

#include <fmt/core.h>

#include "daemon/campaign/campaign.h"
#include "daemon/runner/progress.h"

namespace gyrocal::replay {
namespace {

/// What the numbers of an analysis may differ by: another processor, another compiler rounds the
/// sums over 3000 samples otherwise. Two replays on one machine are compared to the last bit.
constexpr double analysis_differs_by = 1e-6;

const char* word(CampaignPart part) {
  switch (part) {
    case CampaignPart::events:
      return "decision";
    case CampaignPart::dwells:
      return "dwell";
    case CampaignPart::samples:
      return "sample";
    case CampaignPart::monitor:
      return "slow stream";
    case CampaignPart::drifts:
      return "zero drift";
    case CampaignPart::models:
    case CampaignPart::model_points:
      break;
  }
  return "model";
}

Difference described(CampaignPart part, const RowDifference& row, Duration ended) {
  const bool timed = part != CampaignPart::models && part != CampaignPart::model_points;
  const Duration t = timed ? Duration{row.t_ns} : ended;
  const std::string column = row.column.empty() ? "" : row.column + " ";
  return {0,
          t,
          word(part),
          column + row.expected,
          column + row.got,
          fmt::format("{} ({}): {}{} was stored then, the replay stores {}", row.row,
                      runner::clock_text(t), column, row.expected, row.got)};
}

std::int64_t* counter(CampaignPart part, ReplayedRun& run) {
  switch (part) {
    case CampaignPart::dwells:
      return &run.dwells;
    case CampaignPart::samples:
      return &run.samples;
    case CampaignPart::monitor:
      return &run.monitor_rows;
    case CampaignPart::models:
      return &run.models;
    case CampaignPart::events:
    case CampaignPart::drifts:
    case CampaignPart::model_points:
      break;
  }
  return nullptr;
}

void keep_earlier(Difference difference, std::optional<Difference>& first) {
  if (!first || difference.t < first->t) first = std::move(difference);
}

Result<void> check_part(const RowCheck& check, CampaignPart part, std::int64_t to_ns,
                        bool ends_together, double relative, RunResult& result) {
  CampaignWindow recorded = check.recorded;
  CampaignWindow replayed = check.replayed;
  recorded.to_ns = replayed.to_ns = to_ns;
  const auto compared = compare_campaigns(recorded, replayed, part, relative);
  if (!compared) return tl::unexpected(compared.error());
  if (std::int64_t* const count = counter(part, result.run)) *count = compared->rows;
  if (compared->difference) {
    keep_earlier(described(part, *compared->difference, check.ended), result.difference);
  } else if (compared->beyond && ends_together) {
    keep_earlier(described(part, *compared->beyond, check.ended), result.difference);
  } else if (!ends_together && !result.difference) {
    result.run.unchecked_rows += compared->more_expected;
  }
  return {};
}

}  // namespace

Result<void> check_rows(const RowCheck& check, RunResult& result) {
  const bool ends_together = !result.run.cut_off && !result.difference;
  const std::int64_t end_ns = (check.ended + end_slack).count();
  const std::int64_t next_ns = check.next.value_or(std::numeric_limits<std::int64_t>::max());
  const std::int64_t to_ns = ends_together ? end_ns : next_ns;
  for (const auto part :
       {CampaignPart::events, CampaignPart::dwells, CampaignPart::samples, CampaignPart::monitor}) {
    if (auto done = check_part(check, part, to_ns, ends_together, 0, result); !done) return done;
  }
  if (result.run.ended != campaign::name(campaign::Finished{})) return {};
  for (const auto part : {CampaignPart::drifts, CampaignPart::models, CampaignPart::model_points}) {
    auto done = check_part(check, part, std::numeric_limits<std::int64_t>::max(), ends_together,
                           analysis_differs_by, result);
    if (!done) return done;
  }
  return {};
}

}  // namespace gyrocal::replay
