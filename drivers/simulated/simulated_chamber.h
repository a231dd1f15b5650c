#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "compensation/rig/chamber_air.h"
#include "config/chamber_profile.h"
#include "config/rig_faults.h"
#include "drivers/chamber/chamber.h"
#include "drivers/chamber/pdu.h"
#include "drivers/clock.h"
#include "drivers/link.h"
#include "drivers/simulated/chamber_answer.h"

namespace gyrocal {

/// The controller of a simulated chamber: the register map of a profile in front of the rig's air.
/// Pure: time arrives with each request, and nothing happens between requests that a closed form
/// would not give.
///
/// A register answers only to the functions its profile names, as holding and input registers are
/// two tables: function 1 2 5 ... -> exception 1; a register that is not there, or half of a
/// float -> exception 2; a setpoint outside the limits or no number, an unknown state ->
/// exception 3. Whether a real Yinhe checks its setpoints is not known.
class SimulatedChamber {
 public:
  /// Stopped at ambient, setpoint 25 degC, constant mode; a profile without a run register runs.
  /// `air` must outlive the chamber and be commanded by nobody else.
  SimulatedChamber(const ChamberProfile& profile, int unit, rig::ChamberAir& air);

  /// What the controller says and its wire does, faults included.
  /// @param request  unit id and PDU. Times never go backwards.
  [[nodiscard]] ChamberAnswer exchange(std::span<const std::uint8_t> request, Instant now);
  /// What the controller of a sound wire says: unit id and PDU of the reply; nothing if the request
  /// is for another unit.
  [[nodiscard]] std::optional<Bytes> answer(std::span<const std::uint8_t> request, Instant now);

  /// A fault of the chamber or its wire begins; the same one ends. What happens at an instant only
  /// begins.
  void begin(const RigFault& fault, Instant now);
  void end(const RigFault& fault);
  /// No connection is taken now.
  [[nodiscard]] bool refuses() const { return active(RigFaultKind::refuse) != nullptr; }
  /// Called first in every exchange: what happens at its own time, happens before.
  void before_each(std::function<void(Instant)> hook) { before_each_ = std::move(hook); }

  /// Somebody's hand on the panel: no limit is asked there.
  void set_at_panel(Celsius setpoint, Instant now);
  void set_at_panel(ChamberRun run, Instant now);

  [[nodiscard]] Celsius actual(Instant now) const;
  [[nodiscard]] Celsius setpoint() const { return setpoint_; }
  [[nodiscard]] ChamberRun run() const { return run_; }

 private:
  enum class Quantity { actual, setpoint, run_state, run_command, run_type };
  struct Field {
    Quantity quantity;
    RegisterSpec reg;
  };
  struct Write {
    const Field* field;
    double value;
  };
  using Refusal = tl::unexpected<modbus::Exception>;

  [[nodiscard]] tl::expected<Bytes, modbus::Exception> carry_out(
      std::span<const std::uint8_t> request, Instant now);
  [[nodiscard]] tl::expected<modbus::Words, modbus::Exception> read(const modbus::Request& request,
                                                                    Instant now) const;
  [[nodiscard]] tl::expected<std::vector<Write>, modbus::Exception> checked_writes(
      const modbus::Request& request) const;
  [[nodiscard]] bool acceptable(const Field& field, double value) const;
  [[nodiscard]] std::optional<Bytes> answer_for_another(std::span<const std::uint8_t> request,
                                                        Instant now);
  [[nodiscard]] const RigFault* active(RigFaultKind kind) const;
  [[nodiscard]] Celsius thermometer(Instant now) const;
  [[nodiscard]] const Field* field_at(std::uint16_t address, std::uint8_t function) const;
  [[nodiscard]] const StateSpec& states_of(Quantity quantity) const;
  [[nodiscard]] std::optional<double> value_of(const Field& field, Instant now) const;
  void apply(const Write& write);
  void act(Instant now);

  ChamberProfile profile_;
  int unit_;
  rig::ChamberAir& air_;
  std::vector<Field> fields_;
  Celsius setpoint_{25.0};
  ChamberRun run_ = ChamberRun::stopped;
  std::string type_ = "constant";
  std::vector<RigFault> active_;
  Celsius stuck_at_{0.0};
  std::function<void(Instant)> before_each_;
};

}  // namespace gyrocal
