#include "tests/bench/row.h"

#include <fmt/format.h>

#include <array>
#include <cstdio>

namespace gyrocal::bench {
namespace {

struct Unit {
  double seconds;
  const char* name;
};

Unit unit_for(double seconds) {
  constexpr std::array units{Unit{1e-9, "ns"}, Unit{1e-6, "us"}, Unit{1e-3, "ms"}};
  for (const Unit& unit : units) {
    if (seconds < 999.5 * unit.seconds) return unit;
  }
  return {1, "s"};
}

std::string three_digits(double value) {
  return value < 999.5 ? fmt::format("{:.3g}", value) : fmt::format("{:.0f}", value);
}

std::string shown_limit(double seconds) {
  const Unit unit = unit_for(seconds);
  return fmt::format("<= {:.4g} {}", seconds / unit.seconds, unit.name);
}

}  // namespace

std::string shown_s(const Spread& seconds) {
  const Unit unit = unit_for(seconds.median);
  return fmt::format("{} {} [{}, {}]", three_digits(seconds.median / unit.seconds), unit.name,
                     three_digits(seconds.least / unit.seconds),
                     three_digits(seconds.most / unit.seconds));
}

std::string shown(double value, const std::string& unit) {
  return fmt::format("{:.4g} {}", value, unit);
}

Row against(const std::string& job, const Spread& ours_s, const Peer& peer,
            std::optional<double> ratio_wanted, const std::string& beside) {
  Row row{.job = job,
          .ours = shown_s(ours_s),
          .peer = peer.name,
          .peer_took = "absent: apt-get install " + peer.package,
          .ratio = "",
          .wanted = ratio_wanted ? fmt::format(">= {:.3g} x", *ratio_wanted) : "",
          .beside = beside};
  if (!peer.took_s) return row;
  const double ratio = peer.took_s->median / ours_s.median;
  row.peer_took = shown_s(*peer.took_s);
  row.ratio = fmt::format("{:.3g} x", ratio);
  if (ratio_wanted) row.met = ratio >= *ratio_wanted;
  return row;
}

Row within(const std::string& job, const Spread& ours_s, std::optional<double> most_s,
           const std::string& beside) {
  Row row = number(job, shown_s(ours_s), most_s ? shown_limit(*most_s) : "", {}, beside);
  if (most_s) row.met = ours_s.median <= *most_s;
  return row;
}

Row number(const std::string& job, const std::string& ours, const std::string& wanted,
           std::optional<bool> met, const std::string& beside) {
  return {.job = job,
          .ours = ours,
          .peer = "",
          .peer_took = "",
          .ratio = "",
          .wanted = wanted,
          .met = met,
          .beside = beside};
}

Row failed(const std::string& job, const std::string& why) {
  return number(job, "failed", "", {}, why);
}

void append(Rows& to, Rows from) {
  for (Row& row : from) to.push_back(std::move(row));
}

void print_head() {
  fmt::print("{:<48} {:<25} {:<18} {:<25} {:>7} {:>10} {:<3} {}\n", "job", "gyrocal", "peer",
             "the peer took", "ratio", "wanted", "met", "beside it");
}

void print(const Row& row) {
  const char* const met = !row.met ? "" : *row.met ? "yes" : "NO";
  fmt::print("{:<48} {:<25} {:<18} {:<25} {:>7} {:>10} {:<3} {}\n", row.job, row.ours, row.peer,
             row.peer_took, row.ratio, row.wanted, met, row.beside);
  std::fflush(stdout);
}

}  // namespace gyrocal::bench
