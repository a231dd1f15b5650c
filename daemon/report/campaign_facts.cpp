#include "daemon/report/campaign_facts.h"

#include <fmt/core.h>

#include "config/drift_model/model_json.h"
#include "schema/table_reader.h"

namespace gyrocal::report {
namespace {

Result<std::vector<ModelFacts>> models_of(const Store& store, CampaignId campaign, BoardId board,
                                          Axis axis) {
  auto rows = store.models(campaign, board, axis);
  if (!rows) return tl::unexpected(rows.error());
  std::vector<ModelFacts> models;
  for (ModelInsert& row : *rows) {
    const auto json = nlohmann::ordered_json::parse(row.parameters_json, nullptr, false);
    const auto parameters = parameters_from_json(json);
    if (!parameters) return tl::unexpected(parameters.error());
    auto curve = curve_of(row.method, *parameters);
    if (!curve) return tl::unexpected(curve.error());
    models.push_back({std::move(row), std::move(*curve)});
  }
  return models;
}

Result<AxisFacts> axis_facts(const Store& store, CampaignId campaign, BoardId board, Axis axis) {
  AxisFacts facts;
  facts.axis = axis;
  auto drifts = store.drifts(campaign, board, axis);
  if (!drifts) return tl::unexpected(drifts.error());
  facts.drifts = std::move(*drifts);
  auto models = models_of(store, campaign, board, axis);
  if (!models) return tl::unexpected(models.error());
  facts.models = std::move(*models);
  auto session = store.session(campaign, board, axis);
  if (!session) return tl::unexpected(session.error());
  facts.session = std::move(*session);
  return facts;
}

Result<BoardFacts> board_facts(const Store& store, CampaignId campaign, BoardId id, BoardRow row) {
  BoardFacts facts{id, std::move(row), {}, {}};
  auto accepted = store.accepted_dwells(campaign, id);
  if (!accepted) return tl::unexpected(accepted.error());
  facts.accepted = std::move(*accepted);
  for (const Axis axis : all_axes) {
    if (!facts.board.measured[static_cast<std::size_t>(axis)]) continue;
    auto one = axis_facts(store, campaign, id, axis);
    if (!one) return tl::unexpected(one.error());
    facts.axes.push_back(std::move(*one));
  }
  return facts;
}

std::string text_of(const Cell& cell) {
  if (const auto* whole = std::get_if<std::int64_t>(&cell)) return fmt::format("{}", *whole);
  if (const auto* real = std::get_if<double>(&cell)) return fmt::format("{:.3g}", *real);
  if (const auto* text = std::get_if<std::string>(&cell)) return *text;
  return "-";
}

Result<std::vector<std::vector<std::string>>> gap_steps_of(const std::string& database) {
  auto reader = TableReader::open(database, "gap_history");
  if (!reader) return tl::unexpected(reader.error());
  std::vector<std::vector<std::string>> rows;
  std::vector<Cell> row;
  for (;;) {
    const auto more = reader->next(row);
    if (!more) return tl::unexpected(more.error());
    if (!*more) return rows;
    rows.emplace_back();
    for (const Cell& cell : row) rows.back().push_back(text_of(cell));
  }
}

}  // namespace

Result<CampaignFacts> read_campaign_facts(const std::string& database) {
  const auto store = Store::open_read_only(database);
  if (!store) return tl::unexpected(store.error());
  const auto latest = store->latest_campaign();
  if (!latest) return tl::unexpected(latest.error());
  if (!*latest) {
    return fail(Errc::bad_input, fmt::format("{}: holds no campaign", database),
                "run one, or import a session");
  }
  const CampaignId id = **latest;
  CampaignFacts facts;
  auto campaign = store->campaign(id);
  if (!campaign) return tl::unexpected(campaign.error());
  facts.campaign = std::move(*campaign);
  // An imported session has no campaign file: it is told without its settings.
  if (auto config = parse_campaign(facts.campaign.config_toml, database)) {
    facts.config = std::move(*config);
  }
  auto boards = store->boards(id);
  if (!boards) return tl::unexpected(boards.error());
  for (auto& [board_id, row] : *boards) {
    auto board = board_facts(*store, id, board_id, std::move(row));
    if (!board) return tl::unexpected(board.error());
    facts.boards.push_back(std::move(*board));
  }
  auto dwells = store->dwells(id);
  if (!dwells) return tl::unexpected(dwells.error());
  facts.dwells = std::move(*dwells);
  auto events = store->events(id);
  if (!events) return tl::unexpected(events.error());
  facts.events = std::move(*events);
  auto analysis = store->analysis_settings(id);
  if (!analysis) return tl::unexpected(analysis.error());
  facts.analysis = std::move(*analysis);
  auto steps = gap_steps_of(database);
  if (!steps) return tl::unexpected(steps.error());
  facts.gap_steps = std::move(*steps);
  return facts;
}

}  // namespace gyrocal::report
