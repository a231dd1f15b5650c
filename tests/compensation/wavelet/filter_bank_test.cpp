#include "compensation/wavelet/filter_bank.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

using namespace gyrocal;

TEST_CASE("the 22 filter banks are those of PyWavelets", "[wavelet][golden]") {
  std::ifstream file(GYROCAL_SOURCE_DIR "/tests/golden/filter_banks.json");
  const auto golden = nlohmann::json::parse(file).at("banks");
  CHECK(golden.size() == 22);
  CHECK(filter_banks().size() == 22);
  for (const auto& [name, filters] : golden.items()) {
    CAPTURE(name);
    const auto bank = find_filter_bank(name);
    REQUIRE(bank.has_value());
    CHECK((*bank)->dec_lo == filters.at("dec_lo").get<std::vector<double>>());
    CHECK((*bank)->dec_hi == filters.at("dec_hi").get<std::vector<double>>());
    CHECK((*bank)->rec_lo == filters.at("rec_lo").get<std::vector<double>>());
    CHECK((*bank)->rec_hi == filters.at("rec_hi").get<std::vector<double>>());
  }
}

TEST_CASE("a low-pass filter is orthonormal to its even shifts", "[wavelet]") {
  for (const FilterBank& bank : filter_banks()) {
    CAPTURE(bank.name);
    const double tolerance = bank.name.starts_with("sym") ? 2e-11 : 1e-15;
    for (std::size_t shift = 0; shift < bank.taps(); shift += 2) {
      double product = shift == 0 ? -1.0 : 0.0;
      for (std::size_t k = shift; k < bank.taps(); ++k) {
        product += bank.rec_lo[k] * bank.rec_lo[k - shift];
      }
      CHECK(std::abs(product) < tolerance);
    }
  }
}

TEST_CASE("an unknown wavelet is answered with the known ones", "[wavelet]") {
  const auto bank = find_filter_bank("db11");
  REQUIRE_FALSE(bank.has_value());
  CHECK(bank.error().code == Errc::unknown_name);
  CHECK(bank.error().what == "unknown wavelet 'db11'");
  CHECK(bank.error().advice ==
        "known wavelets: haar db2 db3 db4 db5 db6 db7 db8 db9 db10 sym2 sym3 sym4 sym5 sym6 sym7 "
        "sym8 coif1 coif2 coif3 coif4 coif5; is db10 meant?");
}
