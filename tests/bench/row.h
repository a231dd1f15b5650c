#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tests/bench/measure.h"

namespace gyrocal::bench {

/// One line of the table, as it is printed.
struct Row {
  std::string job;
  std::string ours;       ///< median [least, most]
  std::string peer;       ///< its name, or how to get it
  std::string peer_took;  ///< the same job
  std::string ratio;      ///< peer / ours
  std::string wanted;     ///< issue 8's limit; empty: none
  std::optional<bool> met{};
  std::string beside;  ///< accuracy, equality, what else was seen
};
using Rows = std::vector<Row>;
void append(Rows& to, Rows from);

/// "12.3 us [11.9, 14.0]"
[[nodiscard]] std::string shown_s(const Spread& seconds);
/// "40.1 MB", "9.6e+06 frames/s": four digits and the unit.
[[nodiscard]] std::string shown(double value, const std::string& unit);

/// How a peer did the same job.
struct Peer {
  std::string name;
  std::optional<Spread> took_s;  ///< absent: the peer is not installed
  std::string package;           ///< Debian's, that brings it
};

/// Ours beside a peer; met if peer / ours is at least `ratio_wanted`.
[[nodiscard]] Row against(const std::string& job, const Spread& ours_s, const Peer& peer,
                          std::optional<double> ratio_wanted, const std::string& beside);
/// Ours alone, met if the median is at most `most_s`.
[[nodiscard]] Row within(const std::string& job, const Spread& ours_s, std::optional<double> most_s,
                         const std::string& beside);
/// A number that is no time.
[[nodiscard]] Row number(const std::string& job, const std::string& ours, const std::string& wanted,
                         std::optional<bool> met, const std::string& beside);
/// A job that could not be done: why stands where its time would.
[[nodiscard]] Row failed(const std::string& job, const std::string& why);

/// Prints the table's head, and a row.
void print_head();
void print(const Row& row);

}  // namespace gyrocal::bench
