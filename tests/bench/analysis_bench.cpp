#include <fmt/format.h>
#include <unistd.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <random>

#include "daemon/runner/analysis.h"
#include "tests/bench/bench_row.h"
#include "tests/bench/child_process.h"
#include "tests/bench/stopwatch.h"

namespace gyrocal::bench {
namespace {

constexpr int setpoints = 25;
constexpr int dwell_samples = 3000;
constexpr double sample_rate_hz = 50;

/// White noise of the paper's 1.31 deg/s on a curved drift, as a board counts it.
std::vector<BoardSample> dwell_at(double board_c, std::mt19937& random) {
  constexpr double lsb_per_dps = 4.13;
  std::normal_distribution<double> noise_dps(0, 1.31);
  std::vector<BoardSample> samples(dwell_samples);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    BoardSample& sample = samples[i];
    sample.t_ns = static_cast<std::int64_t>(1e9 / sample_rate_hz) * static_cast<std::int64_t>(i);
    sample.counter = static_cast<std::uint32_t>(i + 1);
    sample.temperature_raw = static_cast<std::int16_t>(board_c * 256);
    for (std::int16_t& lsb : sample.gyro_lsb) {
      const double rate_dps = 4.3 - 0.01 * board_c + 1e-4 * board_c * board_c + noise_dps(random);
      lsb = static_cast<std::int16_t>(std::lround(lsb_per_dps * rate_dps));
    }
  }
  return samples;
}

Result<CampaignConfig> demo_campaign() {
  return read_campaign(GYROCAL_SOURCE_DIR "/config/campaigns/demo.toml");
}

/// A campaign of one board as the daemon leaves it before its analysis.
Result<void> write_campaign(const std::string& path) {
  auto store = Store::open(path);
  if (!store) return tl::unexpected(store.error());
  std::vector<SetpointRow> plan;
  for (int i = 0; i < setpoints; ++i) plan.push_back({i, Celsius{-10 + 2.5 * i}});
  CampaignRow row;
  row.name = "bench";
  row.samples_per_setpoint = dwell_samples;
  row.sample_rate_hz = sample_rate_hz;
  row.state = "analysing";
  const auto campaign = store->begin_campaign(row, plan);
  if (!campaign) return tl::unexpected(campaign.error());
  const auto board = store->add_board(*campaign, {.name = "board0",
                                                  .device = "bench",
                                                  .mcu_id = "",
                                                  .firmware_version = "",
                                                  .hardware_version = "",
                                                  .lsb_per_dps = {4.13, 4.13, 4.13},
                                                  .lsb_per_dps_per_k = {0.002, 0.002, 0.002}});
  if (!board) return tl::unexpected(board.error());
  std::mt19937 random(11);
  for (const SetpointRow& setpoint : plan) {
    const double board_c = setpoint.setpoint.value + 1;
    const std::vector<BoardSample> samples = dwell_at(board_c, random);
    DwellRow dwell;
    dwell.board = *board;
    dwell.ordinal = setpoint.ordinal;
    dwell.t_end_ns = samples.back().t_ns;
    dwell.board_mean_c = board_c;
    const auto stored = store->add_group(*campaign, std::array{DwellWithSamples{dwell, samples}});
    if (!stored) return tl::unexpected(stored.error());
  }
  return {};
}

/// CPU time of reading every sample [s].
Result<double> reading_s(const std::string& path) {
  const double before = cpu_now_s();
  const auto store = Store::open_read_only(path);
  if (!store) return tl::unexpected(store.error());
  const auto dwells = store->accepted_dwells(CampaignId{1}, BoardId{1});
  if (!dwells) return tl::unexpected(dwells.error());
  for (const AcceptedDwell& dwell : *dwells) {
    const auto samples = store->samples(dwell.id);
    if (!samples) return tl::unexpected(samples.error());
  }
  return cpu_now_s() - before;
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

template <class Run>
std::optional<ChildResult> cheapest(Run run, int times) {
  std::optional<ChildResult> best;
  for (int i = 0; i < times; ++i) {
    auto result = run();
    if (!result) return std::nullopt;
    if (!best || result->cpu_s < best->cpu_s) best = std::move(result);
  }
  return best;
}

}  // namespace

int analyse_file(const std::string& path) {
  const auto campaign = demo_campaign();
  auto store = Store::open(path);
  if (!campaign || !store) return 1;
  return runner::analyse_campaign(*store, CampaignId{1}, *campaign, "bench") ? 0 : 1;
}

std::vector<Row> analysis_rows(const std::string& this_program) {
  const std::string path = std::filesystem::temp_directory_path() /
                           ("gyrocal_bench." + std::to_string(getpid()) + ".db");
  std::vector<Row> rows;
  if (const auto written = write_campaign(path); !written) {
    fmt::print(stderr, "bench: {}\n", written.error().what);
    return rows;
  }
  const auto ours = cheapest([&] { return run_child({this_program, "--analyse", path}); }, 7);
  const auto peer = cheapest([&] { return run_python({GYROCAL_ANALYSIS_PEER, path}); }, 3);
  double reading = INFINITY;
  for (int i = 0; i < 7; ++i) reading = std::min(reading, reading_s(path).value_or(INFINITY));
  const auto json = peer ? nlohmann::json::parse(peer->printed) : nlohmann::json();
  if (ours) {
    rows.push_back({"campaign of 75000 samples x 3 axes to models", ours->cpu_s, "Python",
                    peer ? std::optional(peer->cpu_s) : std::nullopt, 10,
                    peer ? difference(path, json) : "no peer"});
  }
  rows.push_back({"reading its samples alone", reading, "sqlite3.py",
                  peer ? std::optional(json.at("reading_s").get<double>()) : std::nullopt,
                  std::nullopt, ""});
  for (const char* suffix : {"", "-wal", "-shm", ".lock"}) std::filesystem::remove(path + suffix);
  return rows;
}

}  // namespace gyrocal::bench
