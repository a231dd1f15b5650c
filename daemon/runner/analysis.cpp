#include "daemon/runner/analysis.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <functional>
#include <future>
#include <iterator>
#include <numeric>
#include <optional>
#include <thread>

#include "compensation/drift/analysis.h"
#include "compensation/drift/mean_error.h"
#include "compensation/drift/setpoint_means.h"
#include "config/drift_model/model_json.h"
#include "daemon/runner/sha256.h"

namespace gyrocal::runner {
namespace {

constexpr double scale_factor_at_c = 20;

struct Dwell {
  AcceptedDwell row;
  std::vector<BoardSample> samples;
};

struct Moments {
  double mean;
  double deviation;
};

Moments moments(std::span<const double> values) {
  const double n = double(values.size());
  const double mean = std::accumulate(values.begin(), values.end(), 0.0) / n;
  double squares = 0;
  for (const double v : values) squares += (v - mean) * (v - mean);
  return {mean, values.size() > 1 ? std::sqrt(squares / (n - 1)) : 0};
}

/// Writes a number's bytes, lowest first. @return where the next goes.
template <class Number>
std::uint8_t* put(std::uint8_t* to, Number value) {
  const auto bits = static_cast<std::make_unsigned_t<Number>>(value);
  for (std::size_t i = 0; i < sizeof bits; ++i) *to++ = static_cast<std::uint8_t>(bits >> 8 * i);
  return to;
}

/// Over counter, counts and temperature of every sample, dwell after dwell.
std::string hash_of(std::span<const Dwell> dwells) {
  Sha256 hash;
  std::vector<std::uint8_t> bytes;
  for (const Dwell& dwell : dwells) {
    constexpr std::size_t count_bytes = 8, sample_bytes = 4 + 3 * 2 + 2;
    bytes.resize(count_bytes + dwell.samples.size() * sample_bytes);
    std::uint8_t* next = put(bytes.data(), std::uint64_t{dwell.samples.size()});
    for (const BoardSample& sample : dwell.samples) {
      next = put(next, std::uint32_t{sample.counter});
      for (const std::int16_t lsb : sample.gyro_lsb) next = put(next, lsb);
      next = put(next, sample.temperature_raw.value_or(INT16_MIN));
    }
    hash.add(bytes);
  }
  return hash.finish();
}

std::string settings_json(const AnalysisConfig& config) {
  return nlohmann::ordered_json{{"wavelet", config.wavelet},
                                {"mode", config.mode},
                                {"level", config.level},
                                {"rule", config.rule}}
      .dump();
}

class BoardAnalysis {
 public:
  BoardAnalysis(BoardId id, BoardRow board, double sample_rate_hz, std::vector<Dwell> dwells)
      : id_(id),
        board_(std::move(board)),
        sample_rate_hz_(sample_rate_hz),
        dwells_(std::move(dwells)),
        hash_(hash_of(dwells_)) {}

  [[nodiscard]] Result<void> axis(Axis axis, Denoiser& denoiser,
                                  std::vector<DwellDriftInsert>& drifts,
                                  std::vector<ModelInsert>& models) const {
    DriftTable table;
    std::vector<double> errors_dps;  ///< as many as the table, or none: a dwell has no known error
    bool errors_known = true;
    Denoised filtered;
    for (const Dwell& dwell : dwells_) {
      const auto rates = rates_dps(dwell.samples, axis, board_, dwell.row.board_mean_c);
      if (auto done = denoiser.run(rates, filtered); !done) return done;
      const Moments before = moments(rates);
      const Moments after = moments(filtered.denoised);
      const auto error = standard_error_of_mean(rates, sample_rate_hz_);
      drifts.push_back({dwell.row.id, axis, before.mean, before.deviation, after.mean,
                        after.deviation, error.value_or(missing)});
      errors_known = errors_known && error.value_or(0) > 0;
      errors_dps.push_back(error.value_or(missing));
      table.temperature_c.push_back(dwell.row.setpoint.value);
      table.zero_drift_dps.push_back(after.mean);
    }
    if (!errors_known) errors_dps.clear();
    auto by_setpoint = setpoint_means(table, errors_dps);
    if (!by_setpoint) return tl::unexpected(by_setpoint.error());
    AnalysisOptions options;
    options.standard_error_dps = by_setpoint->standard_error_dps;
    auto analysis = analyse(by_setpoint->table, options);
    if (!analysis) return tl::unexpected(analysis.error());
    for (std::size_t i = 0; i < analysis->models.size(); ++i) {
      models.push_back(with_provenance(model_row(analysis->models[i], id_, axis)));
      if (analysis->recommended == i) {
        models.back().recommended = true;
        models.back().reason = analysis->reason;
      }
    }
    return {};
  }

 private:
  [[nodiscard]] ModelInsert with_provenance(ModelInsert insert) const {
    insert.dwells_sha256 = hash_;
    for (const Dwell& dwell : dwells_) insert.dwells.push_back(dwell.row.id);
    return insert;
  }

  BoardId id_;
  BoardRow board_;
  double sample_rate_hz_;
  std::vector<Dwell> dwells_;
  std::string hash_;
};

Result<std::vector<Dwell>> read_dwells(const Store& store, CampaignId campaign, BoardId board) {
  auto rows = store.accepted_dwells(campaign, board);
  if (!rows) return tl::unexpected(rows.error());
  std::vector<Dwell> dwells;
  for (const AcceptedDwell& row : *rows) {
    auto samples = store.samples(row.id);
    if (!samples) return tl::unexpected(samples.error());
    dwells.push_back({row, std::move(*samples)});
  }
  return dwells;
}

/// What became of one board, axis after axis. A board that cannot have a model does not keep the
/// others from theirs.
struct BoardResult {
  std::vector<DwellDriftInsert> drifts;
  std::vector<ModelInsert> models;
  std::optional<Error> trouble;
};

BoardResult analyse_board(BoardId id, const BoardRow& board, double sample_rate_hz,
                          std::vector<Dwell> dwells, const DenoiseSettings& settings) {
  BoardResult result;
  Denoiser denoiser(settings);
  const BoardAnalysis analysis(id, board, sample_rate_hz, std::move(dwells));
  for (const Axis axis : all_axes) {
    const auto done = analysis.axis(axis, denoiser, result.drifts, result.models);
    if (done) continue;
    result.trouble =
        Error{done.error().code,
              fmt::format("board '{}', axis {}: {}", board.name, letter(axis), done.error().what),
              done.error().advice};
  }
  return result;
}

void append(BoardResult& to, BoardResult from) {
  std::move(from.drifts.begin(), from.drifts.end(), std::back_inserter(to.drifts));
  std::move(from.models.begin(), from.models.end(), std::back_inserter(to.models));
  if (from.trouble) to.trouble = std::move(from.trouble);
}

/// The boards of a campaign, one after the other from the store, as many at once as there are
/// processors; results in the order of the boards, so that it makes no difference how many.
Result<BoardResult> analyse_boards(const Store& store, CampaignId campaign, double sample_rate_hz,
                                   const DenoiseSettings& settings) {
  const auto boards = store.boards(campaign);
  if (!boards) return tl::unexpected(boards.error());
  const std::size_t at_once = std::max(1U, std::thread::hardware_concurrency());
  BoardResult all;
  std::deque<std::future<BoardResult>> running;
  const auto finish_first = [&] {
    append(all, running.front().get());
    running.pop_front();
  };
  for (const auto& [id, board] : *boards) {
    auto dwells = read_dwells(store, campaign, id);
    if (!dwells) return tl::unexpected(dwells.error());
    if (running.size() == at_once) finish_first();
    running.push_back(std::async(std::launch::async, analyse_board, id, std::cref(board),
                                 sample_rate_hz, std::move(*dwells), std::cref(settings)));
  }
  while (!running.empty()) finish_first();
  return all;
}

}  // namespace

Result<DenoiseSettings> denoise_settings(const AnalysisConfig& config) {
  auto bank = find_filter_bank(config.wavelet);
  if (!bank) return tl::unexpected(bank.error());
  auto boundary = find_boundary(config.mode);
  if (!boundary) return tl::unexpected(boundary.error());
  auto rule = find_denoise_rule(config.rule);
  if (!rule) return tl::unexpected(rule.error());
  return DenoiseSettings{Wavelet{*bank, *boundary, config.level}, *rule, NoiseEstimate::global};
}

ModelInsert model_row(const FittedModel& model, BoardId board, Axis axis) {
  ModelInsert insert;
  insert.board = board;
  insert.axis = axis;
  insert.method = model.method;
  insert.parameters_json = parameters_to_json(model.parameters).dump();
  insert.rmse_dps = model.training.rmse_n;
  insert.rmse_n_minus_1_dps = model.training.rmse_n_minus_1;
  insert.mae_dps = model.training.mae;
  insert.max_dps = model.training.max;
  insert.loocv_rmse_dps = model.loocv_rmse_dps;
  insert.block_rmse_dps = model.block_rmse_dps;
  insert.effective_parameters = model.effective_parameters;
  insert.warnings = fmt::format("{}", fmt::join(model.warnings, "\n"));
  for (std::size_t i = 0; i < model.setpoint_c.size(); ++i) {
    insert.points.push_back(
        {model.setpoint_c[i], model.measured_dps[i], model.fitted_dps[i], model.band_dps[i]});
  }
  return insert;
}

std::vector<double> rates_dps(std::span<const BoardSample> samples, Axis axis,
                              const BoardRow& board, double dwell_board_c) {
  const auto a = static_cast<std::size_t>(axis);
  const double otherwise_c = std::isnan(dwell_board_c) ? scale_factor_at_c : dwell_board_c;
  std::vector<double> rates;
  rates.reserve(samples.size());
  for (const BoardSample& sample : samples) {
    const double board_c = sample.temperature_raw ? *sample.temperature_raw / 256.0 : otherwise_c;
    const double lsb_per_dps =
        board.lsb_per_dps[a] + board.lsb_per_dps_per_k[a] * (board_c - scale_factor_at_c);
    rates.push_back(sample.gyro_lsb[a] / lsb_per_dps);
  }
  return rates;
}

Result<void> analyse_campaign(Store& store, CampaignId campaign, const CampaignConfig& config,
                              const std::string& software_version) {
  auto settings = denoise_settings(config.analysis);
  if (!settings) return tl::unexpected(settings.error());
  Result<BoardResult> all;
  const auto read = store.snapshot([&]() -> Result<void> {
    all = analyse_boards(store, campaign, config.plan.sample_rate_hz, *settings);
    return all ? Result<void>{} : tl::unexpected(all.error());
  });
  if (!read) return tl::unexpected(read.error());
  auto stored = store.add_analysis(campaign, {settings_json(config.analysis), software_version},
                                   all->drifts, all->models);
  if (!stored) return stored;
  if (all->trouble) return tl::unexpected(*all->trouble);
  return {};
}

}  // namespace gyrocal::runner
