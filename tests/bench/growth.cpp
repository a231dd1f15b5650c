#include "tests/bench/growth.h"

#include <fmt/format.h>

#include <cstdio>

#include "tests/bench/row.h"

namespace gyrocal::bench {

void print_growth_head() {
  fmt::print("{:<46} {:>8}  {}\n", "job", "exponent", "CPU at each size (memory)");
}

void print(const Growth& growth) {
  if (!growth.trouble.empty()) {
    fmt::print("{:<46} {:>8}  {}\n", growth.job, "failed", growth.trouble);
    return;
  }
  std::string points;
  for (std::size_t i = 0; i < growth.work.size(); ++i) {
    const std::string time = shown_s({growth.cpu_s[i], growth.cpu_s[i], growth.cpu_s[i]});
    points += fmt::format("{}{:g} {}: {}", i == 0 ? "" : ", ", growth.work[i], growth.unit,
                          time.substr(0, time.find(" [")));
    if (!growth.memory_bytes.empty()) {
      points += fmt::format(" ({:.0f} MB)", growth.memory_bytes[i] / 1e6);
    }
  }
  fmt::print("{:<46} {:>8.2f}  {}\n", growth.job, exponent(growth.work, growth.cpu_s), points);
  std::fflush(stdout);
}

int run_growth() {
  print_growth_head();
  for (const auto measure :
       {wavelet_growth, fit_growth, models_growth, store_growth, codec_growth, query_growth}) {
    print(measure());
  }
  for (const Growth& growth : campaign_growth()) print(growth);
  return 0;
}

}  // namespace gyrocal::bench
