// Jobs whose growth is measured in this process.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <random>

#include "compensation/drift/analysis.h"
#include "compensation/grey/improved_gm11.h"
#include "compensation/wavelet/denoise.h"
#include "schema/sqlite.h"
#include "tests/bench/canned_board.h"
#include "tests/bench/growth.h"
#include "tests/bench/measure.h"
#include "tests/bench/sample_campaign.h"
#include "tests/bench/scratch.h"

namespace gyrocal::bench {
namespace {

/// A curved drift over temperature with a board's noise.
DriftTable drift_table(int setpoints) {
  std::mt19937 random(6);
  std::normal_distribution<double> noise_dps(0, 0.02);
  DriftTable table;
  for (int i = 0; i < setpoints; ++i) {
    const double c = -10 + 60.0 * i / setpoints;
    table.temperature_c.push_back(c);
    table.zero_drift_dps.push_back(4.3 - 0.01 * c + 1e-4 * c * c + noise_dps(random));
  }
  return table;
}

Result<double> store_cpu_s(const std::string& path, int groups) {
  auto store = Store::open(path);
  if (!store) return tl::unexpected(store.error());
  const CampaignShape shape{.boards = 1, .setpoints = groups, .dwell_samples = 1000};
  std::vector<BoardId> boards;
  const auto campaign = begin_campaign(*store, shape, boards);
  if (!campaign) return tl::unexpected(campaign.error());
  std::mt19937 random(3);
  const auto samples = dwell_at(20, shape.dwell_samples, random);
  const double before = cpu_now_s();
  for (int i = 0; i < groups; ++i) {
    const DwellWithSamples dwell{dwell_row(boards.front(), i, samples), samples};
    const auto stored = store->add_group(*campaign, std::span(&dwell, 1));
    if (!stored) return tl::unexpected(stored.error());
  }
  return cpu_now_s() - before;
}

/// The samples of one dwell in deg/s, by the view.
Result<double> dwell_query_s(const std::string& path) {
  const auto database = Database::open(path, OpenMode::read_only);
  if (!database) return tl::unexpected(database.error());
  bool read = true;
  const Spread taken = time_of_call_s([&] {
    const auto sum = database->integer("SELECT sum(gyro_z_dps) FROM sample_dps WHERE dwell_id = 1");
    read = read && sum.has_value();
  });
  return read ? Result<double>(taken.median) : fail(Errc::storage, path + ": sample_dps");
}

double codec_s(std::size_t frames) {
  constexpr BoardMode mode{400, false, true};
  CannedBoard canned(mode);
  const Bytes bytes = frames_on_wire(mode, frames);
  canned.link().play(bytes, 8 * bytes.size() / frames);
  std::vector<BoardSample> fresh;
  const double before = cpu_now_s();
  while (!canned.link().ended()) {
    canned.clock().sleep_until(canned.clock().now() + std::chrono::milliseconds{20});
    fresh.clear();
    if (!canned.board().drain(fresh)) return NAN;
  }
  return cpu_now_s() - before;
}

}  // namespace

Growth wavelet_growth() {
  Growth growth{"decompose and reconstruct, db4, 5 levels", "samples", {1e4, 1e5, 1e6, 1e7}, {}};
  const Wavelet wavelet{find_filter_bank("db4").value(), Boundary::symmetric, 5};
  Workspace workspace;
  Decomposition bands;
  std::vector<double> back;
  for (const double size : growth.work) {
    const std::vector<double> signal(static_cast<std::size_t>(size), 4.2);
    growth.cpu_s.push_back(time_of_call_s([&] {
                             decompose_into(signal, wavelet, workspace, bands);
                             reconstruct_into(bands, wavelet, workspace, back);
                           }).median);
  }
  return growth;
}

Growth fit_growth() {
  Growth growth{"fit improved GM(1,1)", "setpoints", {25, 250, 2500, 25000}, {}};
  for (const double size : growth.work) {
    const DriftTable table = drift_table(static_cast<int>(size));
    const Eigen::VectorXd drift = Eigen::Map<const Eigen::VectorXd>(
        table.zero_drift_dps.data(), static_cast<Eigen::Index>(table.zero_drift_dps.size()));
    bool fitted = true;
    const Spread taken =
        time_of_call_s([&] { fitted = fitted && fit_improved_gm11(drift).has_value(); });
    if (!fitted) growth.trouble = "no fit";
    growth.cpu_s.push_back(taken.median);
  }
  return growth;
}

Growth models_growth() {
  Growth growth{"every model with its left-out errors", "setpoints", {25, 80, 250, 800}, {}};
  for (const double size : growth.work) {
    const DriftTable table = drift_table(static_cast<int>(size));
    bool analysed = true;
    const Spread taken = cpu_of_runs_s(size > 300 ? 1 : 5,
                                       [&] { analysed = analysed && analyse(table).has_value(); });
    if (!analysed) growth.trouble = "no model";
    growth.cpu_s.push_back(taken.median);
  }
  return growth;
}

Growth store_growth() {
  Growth growth{"store samples, groups of 1000", "samples", {1e3, 1e4, 1e5, 1e6}, {}};
  const Scratch folder;
  for (const double samples : growth.work) {
    const auto taken =
        store_cpu_s(folder / fmt::format("{}.db", samples), static_cast<int>(samples / 1000));
    if (!taken) growth.trouble = taken.error().what;
    growth.cpu_s.push_back(taken.value_or(NAN));
  }
  return growth;
}

Growth codec_growth() {
  Growth growth{"bytes to samples, 8 frames a read", "frames", {1e4, 1e5, 1e6, 1e7}, {}};
  for (const double frames : growth.work) {
    growth.cpu_s.push_back(codec_s(static_cast<std::size_t>(frames)));
  }
  return growth;
}

Growth query_growth() {
  Growth growth{"one dwell by view sample_dps, in a database of", "samples", {1e4, 1e5, 1e6}, {}};
  const Scratch folder;
  for (const double samples : growth.work) {
    const std::string path = folder / fmt::format("{}.db", samples);
    const auto stored = store_cpu_s(path, static_cast<int>(samples / 1000));
    const auto taken = stored ? dwell_query_s(path) : stored;
    if (!taken) growth.trouble = taken.error().what;
    growth.cpu_s.push_back(taken.value_or(NAN));
  }
  return growth;
}

}  // namespace gyrocal::bench
