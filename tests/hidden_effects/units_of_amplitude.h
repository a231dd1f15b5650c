#pragma once
#include <optional>
#include <string>

namespace hidden {

/// `value` in `unit` brought to the coherent unit of its kind (deg/s, degC, s, a plain share, ...),
/// so that 12 mdps and 0.012 deg/s compare.
struct Coherent {
  std::string kind;
  double value;
};
/// @return nothing for a unit no effect of the catalogue is stated in.
std::optional<Coherent> coherent(double value, const std::string& unit);

}  // namespace hidden
