#include "daemon/runner/model_table.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <map>

namespace gyrocal::runner {
namespace {

struct Row {
  const char* method;
  const char* label;
};
constexpr std::array<Row, 3> paper_rows{{{"gm11", "GM(1,1)"},
                                         {"least_squares", "least squares"},
                                         {"improved_gm11", "improved GM(1,1)"}}};

using Models = std::array<std::vector<ModelInsert>, 3>;  // by axis

const ModelInsert* find(const std::vector<ModelInsert>& models, const std::string& method) {
  const auto found = std::find_if(models.begin(), models.end(),
                                  [&](const ModelInsert& m) { return m.method == method; });
  return found == models.end() ? nullptr : &*found;
}

std::string numbers(const ModelInsert* model) {
  if (!model) return fmt::format("  {:>7} {:>7} {:>7}", "-", "-", "-");
  return fmt::format("  {:7.4f} {:7.4f} {:7.4f}", model->rmse_dps, model->mae_dps,
                     model->loocv_rmse_dps);
}

std::string recommended(const std::vector<ModelInsert>& models) {
  for (const auto& model : models) {
    if (model.recommended)
      return fmt::format("  {:<15} {:7.4f}", model.method, model.loocv_rmse_dps);
  }
  return fmt::format("  {:<23}", "no model");
}

std::string board_table(const BoardRow& board, std::size_t dwells, const Models& models) {
  std::string text = fmt::format("Board {} (MCU id {}), {} setpoints, errors in deg/s\n",
                                 board.name, board.mcu_id, dwells);
  text += fmt::format("  {:<17}", "");
  for (const Axis axis : all_axes) text += fmt::format("  {:^23}", letter(axis));
  text += fmt::format("\n  {:<17}", "method");
  for (int i = 0; i < 3; ++i) text += fmt::format("  {:>7} {:>7} {:>7}", "RMSE", "MAE", "LOO");
  text += "\n";
  for (const Row& row : paper_rows) {
    text += fmt::format("  {:<17}", row.label);
    for (const auto& of_axis : models) text += numbers(find(of_axis, row.method));
    text += "\n";
  }
  text += fmt::format("  {:<17}", "recommended");
  for (const auto& of_axis : models) text += recommended(of_axis);
  return text + "\n";
}

}  // namespace

Result<std::string> model_table(const Store& store, CampaignId campaign) {
  auto boards = store.boards(campaign);
  if (!boards) return tl::unexpected(boards.error());
  std::string text;
  for (const auto& [id, board] : *boards) {
    auto dwells = store.accepted_dwells(campaign, id);
    if (!dwells) return tl::unexpected(dwells.error());
    Models models;
    for (const Axis axis : all_axes) {
      auto of_axis = store.models(campaign, id, axis);
      if (!of_axis) return tl::unexpected(of_axis.error());
      models[static_cast<std::size_t>(axis)] = std::move(*of_axis);
    }
    if (!text.empty()) text += "\n";
    text += board_table(board, dwells->size(), models);
  }
  return text;
}

}  // namespace gyrocal::runner
