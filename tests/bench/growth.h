#pragma once

#include <string>
#include <vector>

namespace gyrocal::bench {

/// How a job's cost grows with its size.
struct Growth {
  std::string job;
  std::string unit;  ///< of the work: "samples"
  std::vector<double> work;
  std::vector<double> cpu_s;
  std::vector<double> memory_bytes{};  ///< the most resident; of jobs that are processes
  std::string trouble{};               ///< why it could not be measured
};

void print_growth_head();
void print(const Growth& growth);

[[nodiscard]] Growth wavelet_growth();
[[nodiscard]] Growth fit_growth();
[[nodiscard]] Growth models_growth();  ///< all models with their left-out errors
[[nodiscard]] Growth store_growth();
[[nodiscard]] Growth codec_growth();
[[nodiscard]] Growth query_growth();
/// Campaigns of up to 1000 hours in virtual time; their replay and their diagnosis.
[[nodiscard]] std::vector<Growth> campaign_growth();

/// `gyrocal_bench --growth`. @return its exit code.
[[nodiscard]] int run_growth();

}  // namespace gyrocal::bench
