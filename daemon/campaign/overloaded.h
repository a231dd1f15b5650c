#pragma once

namespace gyrocal::campaign {

/// Lambdas as one visitor; the more special overload wins over a generic one.
template <class... Fs>
struct Overloaded : Fs... {
  using Fs::operator()...;
};
template <class... Fs>
Overloaded(Fs...) -> Overloaded<Fs...>;

}  // namespace gyrocal::campaign
