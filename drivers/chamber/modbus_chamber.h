#pragma once

#include <string>

#include "config/chamber_profile.h"
#include "drivers/chamber/chamber.h"
#include "drivers/chamber/pdu.h"
#include "drivers/clock.h"
#include "drivers/link.h"

namespace gyrocal {

/// A chamber whose registers a profile describes. What it reads is what the chamber says, plausible
/// or not: a lone 0.0 is judged by who watches over the campaign.
///
/// A controller that answers "busy" or "still working" is asked again, three times in all. A failed
/// link is reported at once; whether the command took effect is then unknown.
class ModbusChamber final : public Chamber {
 public:
  /// `link` and `clock` must outlive this.
  ModbusChamber(RequestLink& link, Clock& clock, ChamberProfile profile, int unit);

  /// bad_frame also for a run state whose number the profile does not know.
  [[nodiscard]] Result<ChamberReading> read() override;
  [[nodiscard]] Result<void> set_setpoint(Celsius to) override;
  /// Writes only what is not so already: chambers take harm from being switched often. Without
  /// registers for it there is nothing to command and nothing can fail; refused if the profile can
  /// see that the chamber stands but cannot start it.
  [[nodiscard]] Result<void> run() override;
  [[nodiscard]] Result<void> stop() override;

 private:
  [[nodiscard]] Result<modbus::Words> ask(const modbus::Request& request);
  [[nodiscard]] Result<double> read_value(const RegisterSpec& reg);
  /// @return the value the register was given: rounded to what it can hold.
  [[nodiscard]] Result<double> write_value(const RegisterSpec& reg, double value);
  [[nodiscard]] Result<int> read_number(const RegisterSpec& reg);
  [[nodiscard]] Result<ChamberRun> read_run();
  [[nodiscard]] Result<void> reach_run_state(const std::string& state);
  [[nodiscard]] Result<void> reach(const StateSpec& command, const StateSpec& shown,
                                   const std::string& state);
  [[nodiscard]] Result<int> number_of(const StateSpec& spec, const std::string& state) const;
  void settle();

  RequestLink& link_;
  Clock& clock_;
  ChamberProfile profile_;
  std::uint8_t unit_;
};

}  // namespace gyrocal
