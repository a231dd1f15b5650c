#include "compensation/wavelet/boundary.h"

#include <fmt/format.h>

#include <vector>

#include "compensation/values/nearest_name.h"

namespace gyrocal {
namespace {

std::ptrdiff_t wrapped(std::ptrdiff_t index, std::ptrdiff_t period) {
  const std::ptrdiff_t rest = index % period;
  return rest < 0 ? rest + period : rest;
}

/// The index inside the signal that stands for `index`.
std::ptrdiff_t source_index(std::ptrdiff_t index, std::ptrdiff_t length, Boundary boundary) {
  switch (boundary) {
    case Boundary::symmetric: {
      const std::ptrdiff_t at = wrapped(index, 2 * length);
      return at < length ? at : 2 * length - 1 - at;
    }
    case Boundary::reflect: {
      if (length == 1) return 0;
      const std::ptrdiff_t at = wrapped(index, 2 * length - 2);
      return at < length ? at : 2 * length - 2 - at;
    }
    case Boundary::periodization: {
      const std::ptrdiff_t at = wrapped(index, length + length % 2);
      return at < length ? at : length - 1;
    }
    case Boundary::periodic:
      return wrapped(index, length);
    case Boundary::zero:
    case Boundary::constant:
      break;
  }
  return index < 0 ? 0 : length - 1;
}

}  // namespace

std::string_view name_of(Boundary boundary) {
  switch (boundary) {
    case Boundary::symmetric:
      return "symmetric";
    case Boundary::periodization:
      return "periodization";
    case Boundary::zero:
      return "zero";
    case Boundary::constant:
      return "constant";
    case Boundary::reflect:
      return "reflect";
    case Boundary::periodic:
      return "periodic";
  }
  return "unknown";
}

Result<Boundary> find_boundary(std::string_view name) {
  std::vector<std::string_view> known;
  for (const Boundary boundary : all_boundaries) {
    if (name_of(boundary) == name) return boundary;
    known.push_back(name_of(boundary));
  }
  return fail(Errc::unknown_name, fmt::format("unknown boundary mode '{}'", name),
              known_names("modes", name, known));
}

double continued(std::span<const double> signal, std::ptrdiff_t index, Boundary boundary) {
  const auto length = static_cast<std::ptrdiff_t>(signal.size());
  if (index >= 0 && index < length) return signal[static_cast<std::size_t>(index)];
  if (boundary == Boundary::zero) return 0.0;
  return signal[static_cast<std::size_t>(source_index(index, length, boundary))];
}

}  // namespace gyrocal
