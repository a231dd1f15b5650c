#pragma once

#include <memory>
#include <utility>

#include "compensation/rig/effects/effect.h"

namespace gyrocal::rig {

/// A response that is one function of the instant's drivers (which may keep a little state).
template <class Function>
class Pointwise final : public Response {
 public:
  explicit Pointwise(Function function) : function_(std::move(function)) {}
  double at(const Drivers& now) override { return function_(now); }

 private:
  Function function_;
};

template <class Function>
std::unique_ptr<Response> pointwise(Function function) {
  return std::make_unique<Pointwise<Function>>(std::move(function));
}

/// The laws of one effect, the usual one first.
template <class... Laws>
std::vector<std::unique_ptr<const Law>> laws() {
  std::vector<std::unique_ptr<const Law>> all;
  (all.push_back(std::make_unique<Laws>()), ...);
  return all;
}

inline constexpr double dps_per_mdps = 1e-3;
inline constexpr double s_per_h = 3600.0;

}  // namespace gyrocal::rig
