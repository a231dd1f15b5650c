#include "drivers/simulated/simulated_board.h"

#include <algorithm>
#include <utility>

#include "compensation/values/assert.h"
#include "drivers/simulated/calibrated_frame.h"

namespace gyrocal {
namespace {

constexpr Duration identify_time = std::chrono::milliseconds(3500);
constexpr Duration reset_delay = std::chrono::seconds(5);
constexpr Duration enumeration_time = std::chrono::seconds(1);
constexpr double conversion_s = 0.15;                  // STLM75, longest
constexpr std::int64_t physics_step_ns = 200'000'000;  // of rig::RigBoard
constexpr std::int64_t samples_a_time = 4096;  // keeps a long silence of the reader from the memory

/// A board that lies level in a quiet room: what its other sensors read, raw.
constexpr inemo::DataFrame surroundings{.magnetometer = {211, 0, 408}, .pressure = 16212};

std::int64_t ns(Instant t) { return t.time_since_epoch().count(); }

}  // namespace

SimulatedBoard::SimulatedBoard(rig::RigBoard physics, Accelerometer accelerometer, BoardWire wire,
                               const rig::ChamberAir& air, const McuId& mcu_id,
                               std::size_t output_bytes_max)
    : physics_(std::move(physics)),
      accelerometer_(std::move(accelerometer)),
      wire_(std::move(wire)),
      air_(air),
      firmware_(mcu_id),
      output_bytes_max_(output_bytes_max),
      frame_(surroundings) {}

std::span<const std::uint8_t> SimulatedBoard::output() const {
  return std::span(output_).subspan(output_begin_);
}

void SimulatedBoard::take(std::size_t count) {
  GYROCAL_ASSERT(count <= output_.size() - output_begin_);
  output_begin_ += count;
  if (output_begin_ == output_.size()) {
    output_.clear();
    output_begin_ = 0;
  } else if (output_begin_ > output_.size() / 2) {
    output_.erase(output_.begin(), output_.begin() + static_cast<std::ptrdiff_t>(output_begin_));
    output_begin_ = 0;
  }
  send_held_frame();
}

void SimulatedBoard::receive(std::span<const std::uint8_t> packet, Instant now) {
  advance(now);
  if (!present_ || mute_ || reset_at_) return;
  if (identify_until_) {
    waiting_packet_.assign(packet.begin(), packet.end());
  } else {
    answer(packet, now);
  }
}

void SimulatedBoard::answer(std::span<const std::uint8_t> packet, Instant now) {
  using Deed = BoardFirmware::Deed;
  const auto answer = firmware_.handle(packet, streaming_);
  if (answer.deed == Deed::stop) stop();
  put(answer.reply);
  switch (answer.deed) {
    case Deed::start:
      start(now);
      break;
    case Deed::identify:
      identify_until_ = now + identify_time;
      break;
    case Deed::reset:
      reset_at_ = now + reset_delay;
      break;
    case Deed::leave_for_dfu:
      leave_bus(now);
      break;
    case Deed::stop:
    case Deed::none:
      break;
  }
}

void SimulatedBoard::start(Instant now) {
  const auto hz = inemo::rate_hz(firmware_.mode().rate_code);
  GYROCAL_ASSERT(hz.has_value());
  rate_hz_ = *hz;
  streaming_ = true;
  counter_ = 0;
  frames_left_ = firmware_.mode().sample_count;
  layout_ = inemo::layout_of(firmware_.mode());
  last_temperature_.reset();
  physics_.start(ns(now) + 1'000'000'000 / *hz, rate_hz_);
}

void SimulatedBoard::stop() {
  streaming_ = false;
  counter_ = 0;
}

std::optional<Instant> SimulatedBoard::next_event() const {
  std::optional<Instant> next;
  const auto consider = [&](std::optional<Instant> event) {
    if (event && (!next || *event < *next)) next = event;
  };
  consider(identify_until_);
  consider(reset_at_);
  consider(return_at_);
  if (streaming_) consider(Instant{Duration{physics_.next_sample_ns()}});
  return next;
}

void SimulatedBoard::advance(Instant now) {
  if (before_each_) before_each_(now);
  reach_events(now);
  stream_until(ns(now));
}

void SimulatedBoard::reach_events(Instant now) {
  if (identify_until_ && *identify_until_ <= now) {
    const Instant ended = *identify_until_;
    identify_until_.reset();
    const Bytes packet = std::exchange(waiting_packet_, {});
    stream_until(ns(ended));
    if (!packet.empty()) answer(packet, ended);
  }
  if (reset_at_ && *reset_at_ <= now) {
    const Instant ended = *reset_at_;
    stream_until(ns(ended));
    leave_bus(ended);
    return_at_ = ended + enumeration_time;
  }
  if (return_at_ && *return_at_ <= now) join_bus(*return_at_);
}

void SimulatedBoard::stream_until(std::int64_t t_ns) {
  while (streaming_ && physics_.next_sample_ns() <= t_ns) {
    samples_.clear();
    physics_.take_until(air_, std::min(t_ns, batch_end_ns()), samples_);
    for (const rig::RigSample& sample : samples_) send(sample);
  }
}

/// How far samples may be drawn at once.
std::int64_t SimulatedBoard::batch_end_ns() const {
  // Never past the last frame of a counted acquisition: a sample that is drawn and not needed would
  // change the noise of the next one.
  const std::int64_t count =
      frames_left_ == 0 ? samples_a_time : std::min<std::int64_t>(samples_a_time, frames_left_);
  const auto span_ns = static_cast<std::int64_t>(static_cast<double>(count - 1) * 1e9 / rate_hz_);
  const std::int64_t next_ns = physics_.next_sample_ns();
  if (layout_.accelerometer_at == 0) return next_ns + span_ns;
  // The accelerometer is read where the physics stands, so it must not run ahead a step.
  const std::int64_t step_end_ns = (next_ns / physics_step_ns + 1) * physics_step_ns - 1;
  return std::min(next_ns + span_ns, step_end_ns);
}

void SimulatedBoard::send(const rig::RigSample& sample) {
  if (waiting_) return;
  ++counter_;
  if (!sample.lost && !wire_.loses_frame()) build_frame(sample);
  if (frames_left_ > 0 && --frames_left_ == 0) streaming_ = false;
}

void SimulatedBoard::build_frame(const rig::RigSample& sample) {
  frame_.counter = counter_;
  if (layout_.accelerometer_at != 0) {
    frame_.accelerometer = accelerometer_.read(physics_, sample.t_ns);
  }
  frame_.gyro = sample.gyro_lsb;
  frame_.temperature = thermometer(sample);
  waiting_ = !room_for(layout_.frame_bytes);
  Bytes& into = waiting_ ? held_frame_ : output_;
  const std::size_t begin = into.size();
  if (firmware_.mode().raw) {
    inemo::encode_data_frame(layout_, frame_, into);
  } else {
    inemo::encode_data_frame(layout_, calibrated(frame_, firmware_.parameters()), into);
  }
  wire_.spoil(into, begin);
}

std::int16_t SimulatedBoard::thermometer(const rig::RigSample& sample) {
  const bool too_fast = layout_.temperature_at != 0 && rate_hz_ * conversion_s > 1.0;
  if (!temperature_trap_ || !too_fast || !last_temperature_) {
    last_temperature_ = sample.temperature_raw;
  }
  return *last_temperature_;
}

bool SimulatedBoard::room_for(std::size_t bytes) const {
  return host_open_ && !mute_ && output_.size() - output_begin_ + bytes <= output_bytes_max_;
}

void SimulatedBoard::send_held_frame() {
  if (!waiting_ || !room_for(held_frame_.size())) return;
  output_.insert(output_.end(), held_frame_.begin(), held_frame_.end());
  held_frame_.clear();
  waiting_ = false;
}

void SimulatedBoard::put(std::span<const std::uint8_t> bytes) {
  if (!host_open_ || mute_) return;
  output_.insert(output_.end(), bytes.begin(), bytes.end());
}

void SimulatedBoard::host_closes(Instant now) {
  advance(now);
  host_open_ = false;
  output_.clear();
  output_begin_ = 0;
}

void SimulatedBoard::host_opens(Instant now) {
  advance(now);
  host_open_ = true;
  send_held_frame();
}

void SimulatedBoard::unplug(Instant now) {
  advance(now);
  leave_bus(now);
  return_at_.reset();
}

void SimulatedBoard::plug_in(Instant now) {
  advance(now);
  if (!present_) join_bus(now);
}

void SimulatedBoard::brown_out(Instant now) {
  advance(now);
  boot(now);
}

void SimulatedBoard::begin(const RigFault& fault, Instant now) {
  advance(now);
  switch (fault.kind) {
    case RigFaultKind::unplug:
      return unplug(now);
    case RigFaultKind::reset:
      return brown_out(now);
    case RigFaultKind::mute:
      mute_ = true;
      return;
    case RigFaultKind::freeze_temperature:
      return set_temperature_trap(true);
    default:
      return wire_.set(fault.kind, fault.value);
  }
}

void SimulatedBoard::end(const RigFault& fault, Instant now) {
  advance(now);
  switch (fault.kind) {
    case RigFaultKind::unplug:
      return plug_in(now);
    case RigFaultKind::mute:
      mute_ = false;
      return send_held_frame();
    case RigFaultKind::freeze_temperature:
      return set_temperature_trap(false);
    default:
      return wire_.set(fault.kind, 0.0);
  }
}

void SimulatedBoard::leave_bus(Instant now) {
  boot(now);
  present_ = false;
  output_.clear();
  output_begin_ = 0;
}

void SimulatedBoard::join_bus(Instant now) {
  physics_.power_on(ns(now));
  return_at_.reset();
  present_ = true;
  ++appearance_;
}

void SimulatedBoard::boot(Instant now) {
  firmware_.boot();
  physics_.power_on(ns(now));
  stop();
  waiting_ = false;
  held_frame_.clear();
  waiting_packet_.clear();
  identify_until_.reset();
  reset_at_.reset();
}

}  // namespace gyrocal
