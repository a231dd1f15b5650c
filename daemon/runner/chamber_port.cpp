#include "daemon/runner/chamber_port.h"

namespace gyrocal::runner {

ChamberPort::ChamberPort(Chamber& chamber, const campaign::Plan& plan, const ChamberReading& first,
                         Duration t)
    : chamber_(chamber),
      plan_(plan),
      back_off_(plan.poll_interval,
                std::max(plan.poll_interval, Duration{std::chrono::seconds{30}})),
      last_good_(t),
      latest_(first) {
  static_cast<void>(filter_.pass(first.actual));
}

bool ChamberPort::due(Duration t) const { return t >= next_poll_ && back_off_.due(t); }

std::optional<ChamberReading> ChamberPort::poll(Duration t) {
  next_poll_ = t + plan_.poll_interval;
  auto reading = chamber_.read();
  if (!reading) {
    failed(t, reading.error());
    return std::nullopt;
  }
  failures_ = 0;
  back_off_.succeeded();
  if (!filter_.pass(reading->actual)) return std::nullopt;
  last_good_ = t;
  latest_ = *reading;
  return latest_;
}

void ChamberPort::failed(Duration t, const Error& error) {
  ++failures_;
  trouble_ = to_text(error);
  if (safe_asked_ && away()) back_off_.failed(t);  // before, every second counts
}

void ChamberPort::ramp_to(Duration t, Celsius target) {
  ramp_.emplace(t, latest_.actual, target, plan_.ramp_per_minute);
  commanded_.reset();  // a chamber that was away may have come back with other values
  running_asked_ = latest_.run == ChamberRun::running;
}

void ChamberPort::make_safe() {
  ramp_.reset();
  commanded_.reset();
  safe_asked_ = true;
  safe_confirmed_ = false;
}

Result<void> ChamberPort::write(Celsius to) {
  auto allowed = campaign::commandable(plan_.allowed, to);
  if (!allowed) return tl::unexpected(allowed.error());
  if (commanded_ != to) {
    if (auto done = chamber_.set_setpoint(to); !done) return done;
    commanded_ = to;
  }
  if (running_asked_) return {};
  if (auto done = chamber_.run(); !done) return done;
  running_asked_ = true;
  return {};
}

Result<void> ChamberPort::drive(Duration t) {
  if (away() && !back_off_.due(t)) return {};
  std::optional<Celsius> wanted;
  if (safe_asked_ && !safe_confirmed_) {
    wanted = plan_.safe;
  } else if (ramp_) {
    wanted = ramp_->due(t);
  }
  if (!wanted) return {};
  if (auto done = write(*wanted); !done) {
    commanded_.reset();
    if (done.error().code == Errc::timeout || done.error().code == Errc::link_lost ||
        done.error().code == Errc::bad_frame) {
      failed(t, done.error());
      return {};
    }
    return done;
  }
  if (safe_asked_) {
    safe_confirmed_ = true;
  } else {
    ramp_->written(t, *wanted);
  }
  return {};
}

}  // namespace gyrocal::runner
