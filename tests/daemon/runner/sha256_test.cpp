#include "daemon/runner/sha256.h"

#include <catch2/catch.hpp>
#include <string_view>
#include <vector>

namespace gyrocal::runner {
namespace {

std::string hash(std::string_view text) {
  Sha256 sha;
  sha.add({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
  return sha.finish();
}

}  // namespace

TEST_CASE("the digests FIPS 180-4 prints as examples", "[sha256]") {
  CHECK(hash("") == "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  CHECK(hash("abc") == "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  CHECK(hash("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq") ==
        "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
  CHECK(hash(std::string(1000000, 'a')) ==
        "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

TEST_CASE("pieces hash as the whole does", "[sha256]") {
  const std::vector<std::uint8_t> bytes(200, 0x5a);
  Sha256 whole;
  whole.add(bytes);
  Sha256 pieces;
  for (std::size_t i = 0; i < bytes.size(); i += 7) {
    pieces.add(std::span(bytes).subspan(i, std::min<std::size_t>(7, bytes.size() - i)));
  }
  CHECK(whole.finish() == pieces.finish());
}

}  // namespace gyrocal::runner
