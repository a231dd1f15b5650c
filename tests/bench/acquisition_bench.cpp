#include <fmt/format.h>

#include <deque>
#include <nlohmann/json.hpp>

#include "daemon/runner/dwell_collector.h"
#include "daemon/runner/slow_stream.h"
#include "drivers/board/inemo_board.h"
#include "drivers/board/serial_link.h"
#include "drivers/clocks.h"
#include "tests/bench/child_process.h"
#include "tests/bench/sample_campaign.h"
#include "tests/bench/scratch.h"
#include "tests/bench/sections.h"

namespace gyrocal::bench {
namespace {

constexpr int board_count = 64;
constexpr BoardMode acquisition_mode{400, false, true};
constexpr Duration turn = std::chrono::milliseconds{20};  // of the daemon's loop
const CampaignShape one_dwell_shape{.boards = board_count, .setpoints = 1};

struct Side {
  explicit Side(const std::string& device, Clock& clock)
      : link(device), board(link, clock), slow(seconds(5), Duration{}) {}
  SerialLink link;
  InemoBoard board;
  runner::SlowStream slow;
};

/// The boards of another process, as the daemon's loop treats them: drained one after the other
/// every turn, a dwell collected and stored in one transaction between two turns.
class Acquisition {
 public:
  explicit Acquisition(const nlohmann::json& served) {
    for (const auto& board : served.at("boards")) sides_.emplace_back(board.at("device"), clock_);
  }

  Result<void> open() {
    for (Side& side : sides_) {
      if (const auto opened = side.board.open(acquisition_mode); !opened)
        return tl::unexpected(opened.error());
    }
    for (Side& side : sides_) {
      if (auto started = side.board.start(); !started) return started;
    }
    return {};
  }

  /// Streams until every board's dwell is full, stores it, then streams for `after`.
  Result<void> run(Store& store, CampaignId campaign, const std::vector<BoardId>& ids,
                   Duration after) {
    std::vector<std::size_t> all;
    for (std::size_t i = 0; i < sides_.size(); ++i) all.push_back(i);
    dwell_.begin(now(), all);
    const double wall = wall_now_s();
    const double cpu = cpu_now_s();
    while (!dwell_.full()) {
      if (auto turned = take_turn(); !turned) return turned;
    }
    cpu_share = (cpu_now_s() - cpu) / (wall_now_s() - wall);
    if (auto stored = store_dwell(store, campaign, ids); !stored) return stored;
    for (const Duration end = now() + after; now() < end;) {
      if (auto turned = take_turn(); !turned) return turned;
    }
    for (Side& side : sides_) {
      if (auto stopped = side.board.stop(); !stopped) return stopped;
      const BoardTally& tally = side.board.tally();
      frames += tally.frames;
      lost += tally.missing + tally.rejected + tally.ticks_missed;
    }
    return {};
  }

  double cpu_share = 0;     ///< of one core, all but the store
  double store_cpu_s = 0;   ///< for the dwells
  double store_wall_s = 0;  ///< the loop's pause
  std::uint64_t frames = 0;
  std::uint64_t lost = 0;

 private:
  [[nodiscard]] Duration now() const { return clock_.now().time_since_epoch(); }

  Result<void> take_turn() {
    const Instant began = clock_.now();
    for (std::size_t i = 0; i < sides_.size(); ++i) {
      fresh_.clear();
      if (auto drained = sides_[i].board.drain(fresh_); !drained) return drained;
      dwell_.add(i, fresh_);
      sides_[i].slow.add(fresh_);
    }
    clock_.sleep_until(began + turn);
    return {};
  }

  Result<void> store_dwell(Store& store, CampaignId campaign, const std::vector<BoardId>& ids) {
    const auto group = dwell_.finish(std::nullopt);
    std::vector<DwellWithSamples> rows;
    for (const auto& dwell : group) {
      rows.push_back({dwell_row(ids[dwell.board], 0, dwell.samples), dwell.samples});
    }
    const double wall = wall_now_s();
    const double cpu = cpu_now_s();
    const auto stored = store.add_group(campaign, rows);
    store_cpu_s = cpu_now_s() - cpu;
    store_wall_s = wall_now_s() - wall;
    return stored ? Result<void>{} : tl::unexpected(stored.error());
  }

  ScaledClock clock_;
  std::deque<Side> sides_;
  runner::DwellCollector dwell_{one_dwell_shape.dwell_samples, 0};
  std::vector<BoardSample> fresh_;
};

Result<std::int64_t> samples_stored(const Store& store, CampaignId campaign) {
  const auto dwells = store.dwells(campaign);
  if (!dwells) return tl::unexpected(dwells.error());
  std::int64_t samples = 0;
  for (std::size_t i = 0; i < dwells->size(); ++i) {
    const auto rows = store.samples(DwellId{static_cast<std::int64_t>(i) + 1});
    if (!rows) return tl::unexpected(rows.error());
    samples += std::ssize(*rows);
  }
  return samples;
}

Result<Rows> measure(const Scratch& folder, const nlohmann::json& served) {
  auto store = Store::open(folder / "acquisition.db");
  if (!store) return tl::unexpected(store.error());
  std::vector<BoardId> ids;
  const auto campaign = begin_campaign(*store, one_dwell_shape, ids);
  if (!campaign) return tl::unexpected(campaign.error());
  Acquisition acquisition(served);
  if (auto opened = acquisition.open(); !opened) return tl::unexpected(opened.error());
  auto ran = acquisition.run(*store, *campaign, ids, seconds(2));
  if (!ran) return tl::unexpected(ran.error());
  const auto stored = samples_stored(*store, *campaign);
  if (!stored) return tl::unexpected(stored.error());
  const bool whole = acquisition.lost == 0 && *stored == one_dwell_shape.samples();
  const double share = acquisition.cpu_share;
  return Rows{number("64 boards at 400 Hz on ptys: frames lost",
                     fmt::format("{}", acquisition.lost), "0", whole,
                     fmt::format("of {}; {} in dwells, {} stored", acquisition.frames,
                                 one_dwell_shape.samples(), *stored)),
              number("the same: a core's share, all but the store", shown(100 * share, "%"),
                     "<= 10 %", share <= 0.10, "drivers, dwells, slow stream; user and system"),
              number("the same: storing the dwells",
                     fmt::format("{:.0f} ms", 1e3 * acquisition.store_cpu_s), "", {},
                     fmt::format("the loop's pause is {:.0f} ms wall; the ports buffer meanwhile",
                                 1e3 * acquisition.store_wall_s))};
}

}  // namespace

Rows acquisition_rows() {
  const Scratch folder;
  BackgroundProcess rig({GYROCAL_PROGRAM, "rig", "serve", "--boards", std::to_string(board_count),
                         "--port", "0", "--link-dir", folder / "boards", "--json"});
  const auto served = nlohmann::json::parse(rig.read_line(), nullptr, false);
  if (served.is_discarded())
    return {failed("64 boards on ptys", "gyrocal rig serve did not begin")};
  auto rows = measure(folder, served);
  return rows ? *rows : Rows{failed("64 boards on ptys", to_text(rows.error()))};
}

}  // namespace gyrocal::bench
