#pragma once

#include <string>
#include <tl/expected.hpp>
#include <utility>

namespace gyrocal {

/// What kind of failure, for the caller that must choose a reaction. What a person reads stands in
/// Error::what and Error::advice.
enum class Errc {
  timeout,          ///< no answer in time; the link may still live
  link_lost,        ///< the link is gone (closed, unplugged, refused); reconnect
  refused,          ///< the device answered and said no (Modbus exception, NACK); the link lives
  bad_frame,        ///< bytes that are no frame of the protocol
  mismatch,         ///< a value read back, an identity or a version is not the expected one
  out_of_range,     ///< a number outside what is allowed or known
  not_finite,       ///< NaN or infinity where a number is needed
  too_few_points,   ///< less data than the method needs
  bad_input,        ///< a file, table or text that does not say what it should
  unknown_name,     ///< a name outside the known list (the message prints the list)
  busy,             ///< somebody else holds the device or the file
  storage,          ///< the database or a file cannot be read or written
};

/// An expected failure, as a value.
struct Error {
  Errc code;
  std::string what;    ///< "read 2 registers at 160 from 192.0.2.5:502: no reply in 1 s"
  std::string advice;  ///< "is the panel in network mode?"
  bool operator==(const Error&) const = default;
};

template <class T>
using Result = tl::expected<T, Error>;

[[nodiscard]] inline tl::unexpected<Error> fail(Errc code, std::string what,
                                                std::string advice = {}) {
  return tl::unexpected<Error>(Error{code, std::move(what), std::move(advice)});
}

/// "what; advice", as a log line or stderr shows it.
[[nodiscard]] inline std::string to_text(const Error& error) {
  return error.advice.empty() ? error.what : error.what + "; " + error.advice;
}

}  // namespace gyrocal
