// One group: the dwells of all boards at one setpoint, with every sample, in one transaction.
#include <fmt/core.h>

#include <array>

#include "schema/store_impl.h"

namespace gyrocal {
namespace {

constexpr char insert_dwell[] =
    "INSERT INTO dwell (campaign_id, board_id, ordinal, attempt, t_start_ns, t_end_ns, soak_s, "
    "timed_soak, chamber_mean_c, chamber_peak_to_peak_k, board_mean_c, samples, frames_missing, "
    "counter_first, reject_reason) VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)";

constexpr char insert_sample[] =
    "INSERT INTO sample (dwell_id, seq, t_ns, gyro_x_lsb, gyro_y_lsb, gyro_z_lsb, temperature_raw, "
    "counter) VALUES (?, ?, ?, ?, ?, ?, ?, ?)";

/// Places of samples in a dwell, from the board's frame counter: a hole is a lost frame. A counter
/// that does not grow is a board that restarted; places then go on by one.
class Places {
 public:
  explicit Places(std::int64_t counter_first) : first_(counter_first), last_(counter_first) {}
  std::int64_t next(std::int64_t counter) {
    if (seq_ >= 0)
      seq_ += counter > last_ ? counter - last_ : 1;
    else
      seq_ = 0;
    last_ = counter;
    return seq_;
  }
  /// What must be stored beside the place so that the counter can be told again.
  std::optional<std::int64_t> told_apart() const {
    return first_ + seq_ == last_ ? std::nullopt : std::optional(last_);
  }

 private:
  std::int64_t first_;
  std::int64_t last_;
  std::int64_t seq_ = -1;
};

std::int64_t counter_first(const DwellWithSamples& dwell) {
  return dwell.samples.empty() ? 0 : std::int64_t{dwell.samples.front().counter};
}

Result<DwellId> add_dwell(const Database& database, CampaignId campaign,
                          const DwellWithSamples& with) {
  const DwellRow& dwell = with.dwell;
  const auto done = run(database, insert_dwell, key(campaign), key(dwell.board), dwell.ordinal,
                        dwell.attempt, dwell.t_start_ns, dwell.t_end_ns, dwell.soak_s,
                        dwell.timed_soak, dwell.chamber_mean_c, dwell.chamber_peak_to_peak_k,
                        dwell.board_mean_c, static_cast<std::int64_t>(with.samples.size()),
                        dwell.frames_missing, counter_first(with), dwell.reject_reason);
  if (!done) return tl::unexpected(done.error());
  return DwellId{database.last_insert_id()};
}

Result<void> add_samples(Statement& insert, DwellId dwell, std::span<const BoardSample> samples,
                         const std::array<bool, 3>& measured, std::int64_t first) {
  Places places(first);
  insert.bind(0, key(dwell));
  insert.bind_null(7);
  bool counter_bound = false;
  for (const BoardSample& sample : samples) {
    insert.bind(1, places.next(sample.counter));
    insert.bind(2, sample.t_ns);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const int column = 3 + static_cast<int>(axis);
      measured[axis] ? insert.bind(column, int{sample.gyro_lsb[axis]}) : insert.bind_null(column);
    }
    sample.temperature_raw ? insert.bind(6, int{*sample.temperature_raw}) : insert.bind_null(6);
    const auto counter = places.told_apart();
    if (counter || counter_bound) insert.bind(7, counter);
    counter_bound = counter.has_value();
    if (auto done = insert.run_bound(); !done) return done;
  }
  return {};
}

Result<std::array<bool, 3>> measured_axes(const Database& database, BoardId board) {
  std::array<bool, 3> measured{};
  const auto read = for_each_row(
      database, "SELECT axes FROM board WHERE id = ?",
      [&](const Statement& row) {
        for (const Axis axis : all_axes) {
          measured.at(static_cast<std::size_t>(axis)) =
              row.text(0).find(letter(axis)) != std::string::npos;
        }
      },
      key(board));
  if (!read) return tl::unexpected(read.error());
  return measured;
}

}  // namespace

Result<std::vector<DwellId>> Store::add_group(CampaignId campaign,
                                              std::span<const DwellWithSamples> dwells) {
  if (!impl_->insert_sample) {
    auto prepared = impl_->database.prepare(insert_sample);
    if (!prepared) return tl::unexpected(prepared.error());
    impl_->insert_sample = std::move(*prepared);
  }
  std::vector<DwellId> ids;
  const auto what = dwells.empty()
                        ? std::string("an empty group")
                        : fmt::format("the dwells of setpoint {}", dwells.front().dwell.ordinal);
  const auto stored = impl_->write(what, [&]() -> Result<void> {
    for (const DwellWithSamples& dwell : dwells) {
      const auto measured = measured_axes(impl_->database, dwell.dwell.board);
      if (!measured) return tl::unexpected(measured.error());
      const auto id = add_dwell(impl_->database, campaign, dwell);
      if (!id) return tl::unexpected(id.error());
      auto done =
          add_samples(*impl_->insert_sample, *id, dwell.samples, *measured, counter_first(dwell));
      if (!done) return done;
      ids.push_back(*id);
    }
    return {};
  });
  if (!stored) return tl::unexpected(stored.error());
  return ids;
}

}  // namespace gyrocal
