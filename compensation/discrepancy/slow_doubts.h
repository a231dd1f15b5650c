#pragma once

#include "compensation/discrepancy/slow_options.h"
#include "compensation/discrepancy/smoother.h"

namespace gyrocal {

/// What a curve over a driver or a noise without a name must gain to be told.
inline constexpr double unknown_gate_nats = 12;
/// A curve that knows no physics must beat the named effects by this much before it is believed
/// more than they: laws are never exact, and the curve picks up what they leave.
inline constexpr double curve_over_name = 1.5;

[[nodiscard]] bool is_noise(const SlowOption& option);
[[nodiscard]] bool is_unknown(const SlowOption& option);
[[nodiscard]] bool is_curve(const SlowOption& option);  ///< as curve_option() makes it

/// The curve as something that could be added to the model.
[[nodiscard]] SlowOption curve_option(const SmoothGain& gain);

/// Whether a curve does so much better than a law of the catalogue that its name is not believed.
[[nodiscard]] bool curve_beats_name(const SmoothGain& curve, const SlowOption& option);

/// Noise and telegraphs explain whatever moves. Whether the curve does better than chance could, so
/// that it and not they is the better story.
[[nodiscard]] bool curve_beats_chance(const SmoothGain& curve, const SlowOption& option);

/// What a drift explains beside the noise that it needs [nat]: what a wrong law leaves over, a
/// little flicker or a random walk may take.
[[nodiscard]] double with_own_noise(const SlowModel& model, const SlowOption& option);

/// Where the bias is nearly straight, a rate effect and a lag of the die differ only in the minutes
/// in which ramps begin and end, and those hang on lags and instants that are assumed. If the lag's
/// first order, -tau b'(T) r, does as well as the rate itself, the lag joins its rivals; if a rate
/// of a part that trails the die does as well as a lag, k r(t - d) with |d| no longer than the lag
/// told or the die's own, or k L[r] with the lag told, the rate joins its rivals. A share of the
/// bias, 0 to 1, that trails the rest makes the tail of a relaxation: if it does as well, the lag
/// joins the relaxation's rivals.
void doubt_lags(const SlowModel& model, SlowOption& option);

}  // namespace gyrocal
