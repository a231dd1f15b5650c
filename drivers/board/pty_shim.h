#pragma once

namespace gyrocal {

/// Whether an open descriptor is the slave end of a pseudo-terminal: a simulated port.
[[nodiscard]] bool is_pseudo_terminal(int fd) noexcept;

}  // namespace gyrocal
