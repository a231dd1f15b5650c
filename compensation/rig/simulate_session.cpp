#include "compensation/rig/simulate_session.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "compensation/rig/portable_math.h"
#include "compensation/rig/rig_board.h"

namespace gyrocal::rig {
namespace {

constexpr double accelerometer_noise_g = 2e-3;

std::int64_t to_ns(double t_s) { return std::llround(t_s * 1e9); }

/// Runs one board through the schedule and writes down what a campaign would.
class Recorder {
 public:
  Recorder(const RigModel& model, const SessionPlan& plan, std::uint64_t seed,
           const SessionSubject& subject)
      : plan_(plan),
        axis_(static_cast<std::size_t>(subject.axis)),
        lsb_dps_(1.0 / model.baseline.lsb_per_dps),
        schedule_(schedule(plan, model.baseline.chamber, seed)),
        board_(model, seed, subject.board),
        accelerometer_({seed, subject.board, 0, accelerometer}) {
    session_.device = fmt::format("simulated board {}", subject.board);
    session_.axis = std::string(1, letter(subject.axis));
    session_.sample_rate_hz = plan.sample_rate_hz;
    session_.monitor_interval_s = plan.monitor_interval_s;
    session_.lsb_dps = lsb_dps_;
    session_.samples_per_dwell = plan.samples_per_dwell;
    for (const PlannedDwell& dwell : schedule_.dwells) {
      const auto number = static_cast<std::int32_t>(session_.dwells.size());
      session_.dwells.push_back({number, dwell.setpoint_c, dwell.t_start_s});
    }
  }

  Session run() {
    board_.start(0, plan_.sample_rate_hz);
    const auto rows = static_cast<std::int64_t>(schedule_.end_s / plan_.monitor_interval_s + 1e-9);
    for (std::int64_t row = 0; row < rows; ++row) record_row(row);
    while (dwell_ < session_.dwells.size()) record_until(board_.next_sample_ns() + to_ns(0.2));
    return std::move(session_);
  }

 private:
  void record_row(std::int64_t row) {
    const double interval_s = plan_.monitor_interval_s;
    const double from_s = static_cast<double>(row) * interval_s;
    sum_lsb_ = sum_board_ = 0.0;
    arrived_ = 0;
    const std::int64_t end_ns = to_ns(from_s + interval_s);
    // In steps of the physics grid: the accelerometer is read at each.
    while (board_.next_sample_ns() < end_ns) {
      record_until(std::min(end_ns - 1, board_.next_sample_ns() + to_ns(0.2)));
    }
    MonitorRow& made = session_.monitor.emplace_back();
    made.t_s = from_s + 0.5 * interval_s;
    made.setpoint_c = schedule_.air.setpoint_at(made.t_s).value;
    made.chamber_c = mean_air_c(from_s, interval_s);
    if (arrived_ == 0) return;
    made.board_c = sum_board_ / arrived_ / 256.0;
    made.gyro_dps = sum_lsb_ / arrived_ * lsb_dps_;
  }

  /// Mean over the interval, from readings a second apart or closer.
  double mean_air_c(double from_s, double interval_s) const {
    const int readings = std::max(4, static_cast<int>(std::ceil(interval_s)));
    double sum = 0.0;
    for (int i = 0; i < readings; ++i) {
      sum += schedule_.air.at(from_s + (i + 0.5) / readings * interval_s).value;
    }
    return sum / readings;
  }

  void record_until(std::int64_t t_ns) {
    if (schedule_.power_cycle_s && t_ns >= to_ns(*schedule_.power_cycle_s)) {
      board_.power_on(to_ns(*schedule_.power_cycle_s));
      schedule_.power_cycle_s.reset();
    }
    taken_.clear();
    board_.take_until(schedule_.air, t_ns, taken_);
    for (const RigSample& sample : taken_) {
      if (!sample.lost) {
        sum_lsb_ += sample.gyro_lsb[axis_];
        sum_board_ += sample.temperature_raw;
        arrived_ += 1;
      }
      record_in_dwell(sample);
    }
  }

  void record_in_dwell(const RigSample& sample) {
    if (dwell_ == session_.dwells.size()) return;
    if (sample.t_ns < to_ns(session_.dwells[dwell_].t_start_s)) return;
    if (!sample.lost) {
      SessionSample& row = session_.samples.emplace_back();
      row.dwell = session_.dwells[dwell_].dwell;
      row.seq = seq_;
      row.t_s = static_cast<double>(sample.t_ns) * 1e-9;
      row.gyro_dps = sample.gyro_lsb[axis_] * lsb_dps_;
      row.acc_g = acceleration(row.t_s);
      row.board_c = sample.temperature_raw / 256.0;
      row.chamber_c = schedule_.air.at(row.t_s).value;
    }
    if (++seq_ == plan_.samples_per_dwell) {
      seq_ = 0;
      ++dwell_;
    }
  }

  std::array<double, 3> acceleration(double t_s) {
    std::array<double, 3> acc_g = board_.specific_force_g();
    for (double& along : acc_g) along += accelerometer_noise_g * accelerometer_.normal();
    for (const Line& line : board_.lines()) {
      if (line.acc_g > 0.0) acc_g[2] += line.acc_g * portable_sine(line.f_hz * t_s);
    }
    for (double& along : acc_g) along = std::floor(along * 1000.0 + 0.5) / 1000.0;  // LSM303: 1 mg
    return acc_g;
  }

  const SessionPlan& plan_;
  std::size_t axis_;
  double lsb_dps_;
  Schedule schedule_;
  RigBoard board_;
  RandomStream accelerometer_;
  Session session_;
  std::vector<RigSample> taken_;
  double sum_lsb_ = 0.0;
  double sum_board_ = 0.0;
  double arrived_ = 0.0;
  std::size_t dwell_ = 0;
  std::int64_t seq_ = 0;
};

}  // namespace

Session simulate_session(const RigModel& model, const SessionPlan& plan, std::uint64_t seed,
                         const SessionSubject& subject) {
  return Recorder(model, plan, seed, subject).run();
}

}  // namespace gyrocal::rig
