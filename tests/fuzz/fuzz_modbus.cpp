/// Both sides of the Modbus codec with mutated PDUs: whatever is decoded must encode to the same
/// bytes, and no reply is taken for an answer that is none.

#include <algorithm>
#include <cmath>

#include "compensation/values/assert.h"
#include "drivers/chamber/pdu.h"
#include "drivers/chamber/register_value.h"
#include "tests/fuzz/loop.h"

using namespace gyrocal;
using namespace gyrocal::modbus;

namespace {

std::vector<Request> requests() {
  return {read_request(1, 3, 160, 2), read_request(1, 4, 0, 125), write_request(1, 6, 102, {7}),
          write_request(1, 16, 1742, {0x41B0, 0}), write_request(9, 16, 0, Words(123, 0xFFFF))};
}

std::vector<fuzz::Bytes> seeds() {
  std::vector<fuzz::Bytes> all{{}};
  for (const Request& request : requests()) {
    all.push_back(encode_request(request));
    all.push_back(is_write(request) ? encode_write_reply(request)
                                    : encode_read_reply(request, Words(request.count, 0x1234)));
    all.push_back(encode_exception(request.unit, request.function, Exception::busy));
  }
  return all;
}

void check_value(std::span<const std::uint16_t> words, std::mt19937_64& random) {
  RegisterSpec reg;
  reg.type = static_cast<RegisterType>(random() % 3);
  reg.order = static_cast<WordOrder>(random() % 2);
  constexpr double scales[] = {1, 0.1, 0.01};
  reg.scale = scales[random() % 3];
  const std::size_t count = word_count(reg.type);
  if (words.size() < count) return;
  const auto value = decode_value(reg, words.first(count));
  if (!value) {
    GYROCAL_ASSERT(value.error().code == Errc::not_finite);
    return;
  }
  GYROCAL_ASSERT(std::isfinite(*value));
  const auto again = encode_value(reg, *value);
  if (!again) {  // the largest floats, rounded up by the scale
    GYROCAL_ASSERT(reg.type == RegisterType::float32 && again.error().code == Errc::out_of_range);
    return;
  }
  const auto back = decode_value(reg, *again);
  GYROCAL_ASSERT(back && std::abs(*back - *value) <= 1e-6 * std::abs(*value));
}

void check_reply(const fuzz::Bytes& bytes, std::mt19937_64& random) {
  static const auto asked = requests();
  const Request& request = asked[random() % asked.size()];
  const auto words = decode_reply(request, bytes);
  if (words) {
    const Bytes same =
        is_write(request) ? encode_write_reply(request) : encode_read_reply(request, *words);
    GYROCAL_ASSERT(same == bytes);
    check_value(*words, random);
  } else if (words.error().code == Errc::refused) {
    GYROCAL_ASSERT(bytes.size() == 3 && exception_in(request, bytes).has_value());
  } else {
    GYROCAL_ASSERT(words.error().code == Errc::bad_frame && !words.error().what.empty());
  }
}

void check(const fuzz::Bytes& bytes, std::mt19937_64& random) {
  if (const auto request = decode_request(bytes)) {
    GYROCAL_ASSERT(encode_request(*request) == bytes);
    check_value(request->values, random);
  }
  check_reply(bytes, random);
}

}  // namespace

int main(int argc, char** argv) { return fuzz::run(argc, argv, seeds(), check); }
