/// The recording's pieces, packed and compressed, mutated: whatever decodes must encode to what
/// decodes to the same, and nothing may ask for more memory than the input can hold.

#include "compensation/values/assert.h"
#include "drivers/recording/compression.h"
#include "tests/drivers/recording/random_events.h"
#include "tests/fuzz/loop.h"

using namespace gyrocal;

namespace {

constexpr std::size_t unpacked_max = 1 << 20;

std::vector<fuzz::Bytes> seeds() {
  std::mt19937 random(1);
  std::vector<fuzz::Bytes> all{{}};
  for (const std::size_t count : {std::size_t{1}, std::size_t{5}, std::size_t{40}}) {
    const Bytes piece = encode_events(test::random_events(count, random));
    all.push_back(piece);
    all.push_back(compressed(piece, 1));
  }
  return all;
}

void check_piece(std::span<const std::uint8_t> bytes) {
  const auto events = decode_events(bytes);
  if (!events) {
    GYROCAL_ASSERT(events.error().code == Errc::bad_frame);
    return;
  }
  std::size_t held = 0;
  for (const auto& event : *events) held += event.sent.size() + event.received.size();
  GYROCAL_ASSERT(held <= bytes.size());
  GYROCAL_ASSERT(decode_events(encode_events(*events)) == *events);
}

void check(const fuzz::Bytes& bytes, std::mt19937_64& /*random*/) {
  check_piece(bytes);
  if (const auto unpacked = decompressed(bytes, unpacked_max)) {
    GYROCAL_ASSERT(unpacked->size() <= unpacked_max);
    check_piece(*unpacked);
  }
}

}  // namespace

int main(int argc, char** argv) { return fuzz::run(argc, argv, seeds(), check); }
