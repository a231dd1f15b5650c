#include "tests/bench/growth.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <cstdio>

#include "tests/bench/row.h"

namespace gyrocal::bench {
namespace {

double mean(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

std::vector<double> logs(const std::vector<double>& values) {
  std::vector<double> result;
  for (const double value : values) result.push_back(std::log(value));
  return result;
}

}  // namespace

double exponent(const std::vector<double>& x, const std::vector<double>& y) {
  const auto log_x = logs(x);
  const auto log_y = logs(y);
  const double mean_x = mean(log_x);
  const double mean_y = mean(log_y);
  double together = 0;
  double alone = 0;
  for (std::size_t i = 0; i < log_x.size(); ++i) {
    together += (log_x[i] - mean_x) * (log_y[i] - mean_y);
    alone += (log_x[i] - mean_x) * (log_x[i] - mean_x);
  }
  return together / alone;
}

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
