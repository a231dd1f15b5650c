#include "tests/hidden_effects/sensor.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hidden {
namespace {

double to_step(double value, double step) { return step * std::round(value / step); }

bool is_missing(const Sensor& sensor, double code) {
  // splitmix64: scatters the holes without a period, which would be another fault.
  auto x = static_cast<std::uint64_t>(static_cast<std::int64_t>(code)) + sensor.missing_key;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ULL;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebULL;
  return static_cast<double>((x ^ (x >> 31)) >> 11) * 0x1p-53 < sensor.missing_share;
}

/// Counts down to the next of events that come with a probability per sample.
class Waiting {
 public:
  Waiting(double probability, Random& random) : probability_(probability), random_(random) {
    again();
  }
  bool fires() {
    if (--left_ > 0) return false;
    again();
    return true;
  }

 private:
  void again() {
    left_ = probability_ > 0.0
                ? 1 + static_cast<std::int64_t>(std::log(random_.uniform(1e-300, 1.0)) /
                                                std::log1p(-probability_))
                : std::numeric_limits<std::int64_t>::max();
  }
  double probability_;
  Random& random_;
  std::int64_t left_ = 0;
};

std::int64_t burst_length(double mean, Random& random) {
  return 1 + static_cast<std::int64_t>(random.exponential(std::max(mean - 1.0, 1e-3)));
}

/// A frequency that wanders about its mean, renewed once a second.
class WanderingLine {
 public:
  WanderingLine(double hz, double wander_hz, double memory_s, Random& random)
      : hz_(hz),
        wander_hz_(wander_hz),
        memory_s_(memory_s),
        phase_(random.uniform(0.0, full_turn)) {}
  void each_second(Random& random) {
    off_hz_ += -off_hz_ / memory_s_ + wander_hz_ * std::sqrt(2.0 / memory_s_) * random.normal();
    phase_ = std::fmod(phase_, full_turn);
  }
  double advance(double step_s) { return phase_ += full_turn * (hz_ + off_hz_) * step_s; }

 private:
  double hz_, wander_hz_, memory_s_, phase_;
  double off_hz_ = 0.0;
};

/// What reaches the converter: bias, noise, lines, telegraph.
class Analog {
 public:
  Analog(const Sensor& sensor, const Trajectory& over, Random& random)
      : sensor_(sensor),
        over_(over),
        random_(random),
        rotor_(sensor.vibration ? sensor.vibration->rotor_hz : 0.0, 0.04, 40.0, random),
        grid_(sensor.hum ? sensor.hum->grid_hz : 0.0, 0.015, 90.0, random) {}

  void each_second(std::size_t second) {
    const double warm_c = over_.die_c[second] - 20.0;
    white_dps_ =
        sensor_.white_dps * std::exp(sensor_.white_per_c * warm_c +
                                     sensor_.white_per_h * static_cast<double>(second) / 3600.0);
    running_ = over_.compressor_on[second] != 0;
    hurry_ = sensor_.telegraph ? std::exp(sensor_.telegraph->warming_per_c * warm_c) : 1.0;
    rotor_.each_second(random_);
    grid_.each_second(random_);
  }

  double next(double bias_dps, double step_s) {
    double value = bias_dps + white_dps_ * random_.normal();
    shake_g_ = 0.0;
    if (sensor_.vibration) value += vibration(step_s);
    if (sensor_.hum) {
      const double phase = grid_.advance(step_s);
      value += sensor_.hum->line_dps *
               (std::sin(phase) + sensor_.hum->second_harmonic * std::sin(2.0 * phase + 0.7));
    }
    if (sensor_.telegraph) value += telegraph(step_s);
    return value;
  }
  double shake_g() const { return shake_g_; }

 private:
  double vibration(double step_s) {
    const double wave = std::sin(rotor_.advance(step_s));
    if (!running_) return 0.0;
    shake_g_ = sensor_.vibration->shake_g * wave;
    return sensor_.vibration->line_dps * wave + sensor_.vibration->step_dps;
  }
  double telegraph(double step_s) {
    const Telegraph& trap = *sensor_.telegraph;
    left_ -= step_s * hurry_;
    while (left_ <= 0.0) {
      high_ = !high_;
      left_ += random_.exponential(high_ ? trap.high_s : trap.low_s);
    }
    return high_ ? trap.height_dps : 0.0;
  }

  const Sensor& sensor_;
  const Trajectory& over_;
  Random& random_;
  WanderingLine rotor_, grid_;
  double white_dps_ = 0.0, hurry_ = 1.0, shake_g_ = 0.0, left_ = 0.0;
  bool running_ = false, high_ = false;
};

/// Converter and link: what happens to a value once it is a number.
class Digital {
 public:
  Digital(const Sensor& sensor, Random& random)
      : sensor_(sensor),
        random_(random),
        glitch_(sensor.glitches ? sensor.glitches->probability : 0.0, random),
        stick_(sensor.sticking ? sensor.sticking->runs_per_sample : 0.0, random),
        burst_(sensor.loss ? sensor.loss->bursts_per_sample : 0.0, random) {}

  double next(double value_dps, Tally& tally) {
    if (stuck_left_ > 0) {
      --stuck_left_;
      tally.stuck += 1.0;
      return last_dps_;
    }
    if (sensor_.rails_dps) value_dps = railed(value_dps, tally);
    double code = std::round(value_dps / sensor_.lsb_dps);
    if (sensor_.missing_share > 0.0) code = neighbour(code, value_dps / sensor_.lsb_dps, tally);
    if (glitch_.fires()) {
      tally.glitched += 1.0;
      code += std::round(random_.sign() * sensor_.glitches->size_dps * random_.uniform(1.0, 4.0) /
                         sensor_.lsb_dps);
    }
    last_dps_ = code * sensor_.lsb_dps;
    if (stick_.fires()) stuck_left_ = burst_length(sensor_.sticking->mean_length, random_);
    return last_dps_;
  }
  bool arrives(Tally& tally) {
    if (burst_.fires()) lost_left_ = burst_length(sensor_.loss->mean_burst, random_);
    if (lost_left_ == 0) return true;
    --lost_left_;
    tally.lost += 1.0;
    return false;
  }

 private:
  double railed(double value_dps, Tally& tally) const {
    const auto [low, high] = *sensor_.rails_dps;
    const double held = std::clamp(value_dps, low, high);
    if (held != value_dps) tally.at_rail += 1.0;
    return held;
  }
  double neighbour(double code, double exact, Tally& tally) const {
    if (!is_missing(sensor_, code)) return code;
    tally.displaced += 1.0;
    const double step = exact >= code ? 1.0 : -1.0;
    while (is_missing(sensor_, code)) code += step;
    return code;
  }

  const Sensor& sensor_;
  Random& random_;
  Waiting glitch_, stick_, burst_;
  double last_dps_ = 0.0;
  std::int64_t stuck_left_ = 0, lost_left_ = 0;
};

/// Means of what arrived within each interval.
class MonitorMeans {
 public:
  MonitorMeans(double interval_s, std::vector<MonitorRow>& rows)
      : interval_s_(interval_s), rows_(rows) {}
  void add_temperatures(double setpoint_c, double air_c, double board_c) {
    setpoint_c_ = setpoint_c;
    air_c_ += air_c;
    board_c_ += board_c;
    readings_ += 1.0;
  }
  void add_gyro(double gyro_dps) {
    gyro_dps_ += gyro_dps;
    samples_ += 1.0;
  }
  void close_until(double t_s) {
    while (t_s >= interval_s_ * static_cast<double>(index_ + 1)) {
      if (readings_ > 0.0) {
        rows_.push_back({(static_cast<double>(index_) + 0.5) * interval_s_, setpoint_c_,
                         air_c_ / readings_, board_c_ / readings_,
                         samples_ > 0.0 ? gyro_dps_ / samples_ : 0.0, samples_ > 0.0});
      }
      air_c_ = board_c_ = readings_ = gyro_dps_ = samples_ = 0.0;
      ++index_;
    }
  }

 private:
  double interval_s_;
  std::vector<MonitorRow>& rows_;
  std::int64_t index_ = 0;
  double setpoint_c_ = 0.0, air_c_ = 0.0, board_c_ = 0.0, readings_ = 0.0, gyro_dps_ = 0.0,
         samples_ = 0.0;
};

}  // namespace

double share_displaced(const Sensor& sensor, double center_dps) {
  double all = 0.0;
  double hit = 0.0;
  const double middle = std::round(center_dps / sensor.lsb_dps);
  const double reach = std::ceil(4.0 * sensor.white_dps / sensor.lsb_dps);
  for (double code = middle - reach; code <= middle + reach; code += 1.0) {
    const double z = (code * sensor.lsb_dps - center_dps) / sensor.white_dps;
    const double weight = std::exp(-0.5 * z * z);
    all += weight;
    if (is_missing(sensor, code)) hit += weight;
  }
  return hit / all;
}

double share_of_codes_missing(const Sensor& sensor, double low_dps, double high_dps) {
  double all = 0.0;
  double missing = 0.0;
  for (double code = std::ceil(low_dps / sensor.lsb_dps); code * sensor.lsb_dps <= high_dps;
       code += 1.0) {
    all += 1.0;
    if (is_missing(sensor, code)) missing += 1.0;
  }
  return missing / all;
}

Measured measure(const Sensor& sensor, const Trajectory& over, const std::vector<double>& bias_dps,
                 const std::vector<double>& tilt_rad, int samples_per_dwell,
                 double monitor_interval_s, Random& random) {
  Measured out;
  Tally elsewhere;
  Analog analog(sensor, over, random);
  Digital digital(sensor, random);
  MonitorMeans means(monitor_interval_s, out.monitor);
  const double step_s = 1.0 / (sensor.rate_hz * (1.0 + sensor.clock_error));
  const std::size_t last = over.seconds() - 1;
  std::size_t dwell = 0;
  std::int64_t seq = 0;
  double air_c = 0.0;
  double board_c = 0.0;
  std::size_t read_until = 0;  // seconds whose temperatures were read
  std::int64_t count = 0;
  for (double t_s = 0.0; t_s < static_cast<double>(last);
       t_s = static_cast<double>(++count) * step_s) {
    const auto second = static_cast<std::size_t>(t_s);
    means.close_until(t_s);
    while (read_until <= second) {
      air_c = to_step(over.air_c[read_until] + 0.01 * random.normal(), sensor.air_step_c);
      board_c = to_step(over.board_c[read_until] * (1.0 + sensor.board_gain) +
                            sensor.board_offset_c + 0.02 * random.normal(),
                        sensor.board_step_c);
      means.add_temperatures(over.setpoint_c[read_until], air_c, board_c);
      analog.each_second(read_until++);
    }
    const double within = t_s - static_cast<double>(second);
    const double bias = bias_dps[second] + within * (bias_dps[second + 1] - bias_dps[second]);
    const bool in_dwell = dwell < over.dwells.size() && t_s >= over.dwells[dwell].start_s;
    Tally& tally = in_dwell ? out.in_dwells : elsewhere;
    tally.all += 1.0;
    const double gyro_dps = digital.next(analog.next(bias, step_s), tally);
    const bool arrived = digital.arrives(tally);
    if (arrived) means.add_gyro(gyro_dps);
    if (!in_dwell) continue;
    if (seq == 0) out.dwell_start_s.push_back(t_s);
    if (arrived) {
      const double tilt = tilt_rad.empty() ? 0.0 : tilt_rad[second];
      out.samples.push_back(
          {static_cast<int>(dwell), seq, t_s, gyro_dps,
           to_step(0.4 * analog.shake_g() + 0.002 * random.normal(), 0.001),
           to_step(std::sin(tilt) + 0.002 * random.normal(), 0.001),
           to_step(std::cos(tilt) + analog.shake_g() + 0.003 * random.normal(), 0.001), board_c,
           air_c});
    }
    if (++seq == samples_per_dwell) {
      seq = 0;
      ++dwell;
    }
  }
  return out;
}

}  // namespace hidden
