#pragma once

#include <poll.h>

#include <string>
#include <vector>

#include "compensation/values/error.h"
#include "drivers/clock.h"
#include "drivers/simulated/simulated_board.h"
#include "drivers/tty_lock.h"

namespace gyrocal {

/// A simulated board at the end of a pseudo-terminal: what /dev/serial/by-id shows of a real one.
/// A symbolic link with a stable name points to the terminal; when the board leaves the bus, link
/// and terminal vanish, and it comes back on whatever terminal is free, as a real one does.
///
/// A read of the terminal is taken for one USB packet, so two commands written at once arrive as
/// one and are refused, as the firmware would. A closed port is noticed (see SimulatedBoard) and
/// its terminal replaced: Linux keeps unread bytes and the exclusive mode of a pseudo-terminal
/// beyond its last close, so that after a killed host only root could open it again.
class BoardPty {
 public:
  /// Creates the link, replacing a link that stands there; refuses any other kind of file.
  /// `board` must outlive this.
  [[nodiscard]] static Result<BoardPty> open(SimulatedBoard& board, const std::string& link,
                                             Instant now);
  BoardPty(BoardPty&& other) noexcept = default;
  BoardPty& operator=(BoardPty&&) = delete;
  BoardPty(const BoardPty&) = delete;
  BoardPty& operator=(const BoardPty&) = delete;
  ~BoardPty();

  [[nodiscard]] const std::string& link() const { return link_; }
  [[nodiscard]] const std::string& terminal() const { return terminal_.name; }

  void watch(std::vector<pollfd>& into) const;
  /// Hears, lets the board work up to `now`, and sends; at once.
  [[nodiscard]] Result<void> serve(Instant now);

 private:
  BoardPty(SimulatedBoard& board, std::string link);
  struct Terminal {
    UniqueFd master{};
    UniqueFd opened{};  // inotify: wakes us when somebody opens the terminal
    std::string name{};
  };
  [[nodiscard]] static Result<Terminal> new_terminal();
  [[nodiscard]] Result<void> attach(Instant now);
  void detach();
  [[nodiscard]] Result<void> notice_host(Instant now);
  [[nodiscard]] Result<void> replace_terminal();
  void hear(Instant now);
  void speak();

  SimulatedBoard* board_;
  std::string link_;
  Terminal terminal_;  // no master while the board is away
  std::uint32_t appearance_ = 0;
  bool host_open_ = false;
};

}  // namespace gyrocal
