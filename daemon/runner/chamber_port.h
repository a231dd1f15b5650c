#pragma once

#include <optional>
#include <string>

#include "daemon/campaign/plan.h"
#include "daemon/campaign/ramp.h"
#include "daemon/campaign/safety.h"
#include "daemon/runner/back_off.h"
#include "drivers/chamber/chamber.h"

namespace gyrocal::runner {

/// The chamber of a campaign: polled, its doubtful readings kept back, ramped by writing setpoints,
/// sent nowhere but where the plan allows.
class ChamberPort {
 public:
  /// @param first  what preflight read at t.
  ChamberPort(Chamber& chamber, const campaign::Plan& plan, const ChamberReading& first,
              Duration t);

  /// A poll is due when the interval, or the back-off of a lost chamber, is over.
  [[nodiscard]] bool due(Duration t) const;
  /// One poll. @return a reading to be believed, or nothing.
  [[nodiscard]] std::optional<ChamberReading> poll(Duration t);

  /// Begins a software ramp from the air's temperature.
  void ramp_to(Duration t, Celsius target);
  void hold() { ramp_.reset(); }
  /// Sends the chamber straight to the safe setpoint; drive() repeats it until it is confirmed.
  void make_safe();
  /// Writes what is due. @return mismatch: another value stands there than was written, and stays
  ///   after every try; the caller takes that for somebody else's hand. Lost links are no error
  ///   here: they show in away() and the write is due again.
  [[nodiscard]] Result<void> drive(Duration t);

  /// The safe setpoint has been asked for and the chamber has confirmed it.
  [[nodiscard]] bool is_safe() const { return safe_asked_ && safe_confirmed_; }
  [[nodiscard]] bool safe_asked() const { return safe_asked_; }
  [[nodiscard]] bool away() const { return failures_ >= failures_before_away; }
  [[nodiscard]] int doubtful_readings() const { return filter_.doubtful(); }
  [[nodiscard]] const std::string& trouble() const { return trouble_; }
  /// Time since the last believed reading.
  [[nodiscard]] Duration age(Duration t) const { return t - last_good_; }
  [[nodiscard]] const ChamberReading& latest() const { return latest_; }
  /// What was last written and confirmed.
  [[nodiscard]] std::optional<Celsius> commanded() const { return commanded_; }

  static constexpr int failures_before_away = 3;

 private:
  [[nodiscard]] Result<void> write(Celsius to);
  void failed(Duration t, const Error& error);

  Chamber& chamber_;
  campaign::Plan plan_;
  campaign::ReadingFilter filter_;
  BackOff back_off_;
  Duration next_poll_ = Duration::min();
  Duration last_good_;
  int failures_ = 0;
  std::string trouble_;
  ChamberReading latest_;
  std::optional<Celsius> commanded_;
  std::optional<campaign::SetpointRamp> ramp_;
  bool running_asked_ = false;
  bool safe_asked_ = false;
  bool safe_confirmed_ = false;
};

}  // namespace gyrocal::runner
