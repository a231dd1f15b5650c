#include "drivers/chamber/register_value.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

using namespace gyrocal;
using modbus::Words;

namespace {
constexpr RegisterSpec yinhe{1742, RegisterType::float32, WordOrder::high_word_first, 1.0, 3, 16};
constexpr RegisterSpec f4t{2782, RegisterType::float32, WordOrder::low_word_first, 1.0, 3, 16};
constexpr RegisterSpec hundredths{102, RegisterType::int16, WordOrder::high_word_first, 0.01, 3, 6};
constexpr RegisterSpec count{200, RegisterType::uint16, WordOrder::high_word_first, 1.0, 3, 16};
}  // namespace

TEST_CASE("22 degC lies in the registers as each controller wants it", "[register]") {
  CHECK(encode_value(yinhe, 22) == Words{0x41B0, 0x0000});
  CHECK(encode_value(f4t, 22) == Words{0x0000, 0x41B0});
  CHECK(encode_value(hundredths, 22) == Words{2200});
  CHECK(encode_value(hundredths, -60) == Words{0xE890});
  CHECK(encode_value(yinhe, -60) == Words{0xC270, 0x0000});
}

TEST_CASE("what is encoded decodes to the same temperature", "[register][property]") {
  for (int tenths = -600; tenths <= 900; ++tenths) {
    const double value = tenths / 10.0;
    for (const RegisterSpec& reg : {yinhe, f4t, hundredths}) {
      const auto words = encode_value(reg, value);
      REQUIRE(words);
      CHECK(*decode_value(reg, *words) == Approx(value).margin(4e-6));
    }
  }
}

TEST_CASE("minus one tenth is not 6553.5", "[register]") {
  const RegisterSpec tenths{1, RegisterType::int16, WordOrder::high_word_first, 0.1, 3, 6};
  CHECK(*decode_value(tenths, Words{0xFFFF}) == Approx(-0.1));
}

TEST_CASE("a register takes no number it cannot hold", "[register]") {
  CHECK(encode_value(hundredths, 327.68).error().code == Errc::out_of_range);
  CHECK(encode_value(hundredths, -327.69).error().code == Errc::out_of_range);
  CHECK(encode_value(count, -1).error().code == Errc::out_of_range);
  CHECK(encode_value(yinhe, 1e300).error().code == Errc::out_of_range);
  CHECK(encode_value(yinhe, std::nan("")).error().code == Errc::not_finite);
  CHECK(encode_value(count, std::numeric_limits<double>::infinity()).error().code ==
        Errc::not_finite);
}

TEST_CASE("the bit patterns of NaN and infinity are not temperatures", "[register]") {
  CHECK(decode_value(yinhe, Words{0x7FC0, 0}).error().code == Errc::not_finite);
  CHECK(decode_value(f4t, Words{0, 0xFF80}).error().code == Errc::not_finite);
}
