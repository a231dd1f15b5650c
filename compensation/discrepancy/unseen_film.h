#pragma once

#include "compensation/discrepancy/slow_search.h"

namespace gyrocal {

/// A film that formed where no fit may look is known by how it dries, and what dries could have
/// been thick early or thin late. Of the films that explain what is seen as well, the thinnest.
[[nodiscard]] SlowCandidate thinnest_film(const SlowModel& model, SlowCandidate candidate);

}  // namespace gyrocal
