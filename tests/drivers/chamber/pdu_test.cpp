#include "drivers/chamber/pdu.h"

#include <catch2/catch.hpp>

using namespace gyrocal;
using namespace gyrocal::modbus;

TEST_CASE("requests have the bytes that work on a Yinhe", "[pdu]") {
  CHECK(encode_request(write_request(1, 16, 1742, {0x41B0, 0x0000})) ==
        Bytes{0x01, 0x10, 0x06, 0xCE, 0x00, 0x02, 0x04, 0x41, 0xB0, 0x00, 0x00});
  CHECK(encode_request(read_request(1, 3, 160, 2)) == Bytes{0x01, 0x03, 0x00, 0xA0, 0x00, 0x02});
  CHECK(encode_request(write_request(1, 16, 200, {1})) ==
        Bytes{0x01, 0x10, 0x00, 0xC8, 0x00, 0x01, 0x02, 0x00, 0x01});
  CHECK(encode_request(write_request(3, 6, 102, {0xE890})) ==
        Bytes{0x03, 0x06, 0x00, 0x66, 0xE8, 0x90});
}

TEST_CASE("the server understands what the client sends", "[pdu]") {
  for (const Request& request :
       {read_request(1, 3, 160, 2), read_request(7, 4, 65535, 125),
        write_request(1, 6, 5, {0xFFFF}), write_request(1, 16, 1742, {0x41B0, 0}),
        write_request(1, 16, 0, Words(123, 9))}) {
    CAPTURE(to_text(request));
    CHECK(decode_request(encode_request(request)) == request);
  }
}

TEST_CASE("the server refuses what it cannot serve with the standard's exception", "[pdu]") {
  const auto refusal = [](const Bytes& bytes) { return decode_request(bytes).error(); };
  CHECK(refusal({1, 1, 0, 0, 0, 1}) == Exception::illegal_function);
  CHECK(refusal({1, 0x11}) == Exception::illegal_function);
  CHECK(refusal({1, 3, 0, 0, 0, 0}) == Exception::illegal_value);
  CHECK(refusal({1, 3, 0, 0, 0, 126}) == Exception::illegal_value);
  CHECK(refusal({1, 3, 0, 0, 0}) == Exception::illegal_value);
  CHECK(refusal({1, 3, 0, 0, 0, 1, 0}) == Exception::illegal_value);
  CHECK(refusal({1, 16, 0, 0, 0, 1, 3, 0, 0}) == Exception::illegal_value);
  CHECK(refusal({1, 16, 0, 0, 0, 2, 4, 0, 0}) == Exception::illegal_value);
  CHECK(refusal({1, 16, 0, 0, 0, 124, 248}) == Exception::illegal_value);
  CHECK(refusal({}) == Exception::illegal_value);
}

TEST_CASE("the client takes the words of a read and the echo of a write", "[pdu]") {
  const Request read = read_request(1, 3, 160, 2);
  CHECK(decode_reply(read, encode_read_reply(read, Words{0x41B0, 0})) == Words{0x41B0, 0});
  const Request write = write_request(1, 16, 200, {1});
  CHECK(encode_write_reply(write) == Bytes{0x01, 0x10, 0x00, 0xC8, 0x00, 0x01});
  CHECK(decode_reply(write, encode_write_reply(write)) == Words{});
  const Request single = write_request(1, 6, 102, {0xE890});
  CHECK(decode_reply(single, encode_write_reply(single)) == Words{});
}

TEST_CASE("a reply that is not to the request is a bad frame", "[pdu]") {
  const Request read = read_request(1, 3, 160, 2);
  const Request write = write_request(1, 16, 1742, {0x41B0, 0});
  const Request single = write_request(1, 6, 102, {7});
  const auto code = [](const Request& request, const Bytes& reply) {
    return decode_reply(request, reply).error().code;
  };
  CHECK(code(read, {}) == Errc::bad_frame);
  CHECK(code(read, {1, 3}) == Errc::bad_frame);
  CHECK(code(read, {2, 3, 4, 0, 0, 0, 0}) == Errc::bad_frame);  // another unit
  CHECK(code(read, {1, 4, 4, 0, 0, 0, 0}) == Errc::bad_frame);  // another function
  CHECK(code(read, {1, 3, 2, 0, 0}) == Errc::bad_frame);        // another count
  CHECK(code(read, {1, 3, 4, 0, 0, 0}) == Errc::bad_frame);     // cut short
  CHECK(code(read, {1, 0x84, 2}) == Errc::bad_frame);           // exception to another function
  CHECK(code(write, {1, 16, 0x06, 0xCF, 0, 2}) == Errc::bad_frame);  // another register
  CHECK(code(single, {1, 6, 0, 102, 0, 8}) == Errc::bad_frame);      // another value
}

TEST_CASE("an exception is a refusal that names the request and the reason", "[pdu]") {
  const Request read = read_request(1, 3, 160, 2);
  const Bytes reply = encode_exception(1, 3, Exception::illegal_address);
  CHECK(reply == Bytes{1, 0x83, 2});
  CHECK(exception_in(read, reply) == Exception::illegal_address);
  const auto words = decode_reply(read, reply);
  REQUIRE_FALSE(words);
  CHECK(words.error().code == Errc::refused);
  CHECK(words.error().what == "read 2 registers at 160: exception 2, illegal address");
}
