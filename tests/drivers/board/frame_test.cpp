#include "drivers/board/frame.h"

#include <catch2/catch.hpp>

using namespace gyrocal;
using namespace gyrocal::inemo;

namespace {
constexpr OutputMode raw_gyro{false, true, false, true, false, false, false, 3, 3000};

OutputMode raw_gyro_and_temperature() {
  OutputMode mode = raw_gyro;
  mode.temperature = true;
  return mode;
}
}  // namespace

TEST_CASE("commands, acknowledgements and refusals have the bytes of the protocol", "[frame]") {
  CHECK(encode_command(Id::connect) == Bytes{0x20, 0x01, 0x00});
  CHECK(encode_ack(Id::connect) == Bytes{0x80, 0x01, 0x00});
  CHECK(encode_nack(0x00, Nack::not_connected) == Bytes{0xC0, 0x02, 0x00, 0x05});
  CHECK(encode_command(Id::start) == Bytes{0x20, 0x01, 0x52});
  CHECK(encode_command(Id::stop) == Bytes{0x20, 0x01, 0x53});
  CHECK(encode_command(Id::set_output_mode, encode_output_mode(raw_gyro)) ==
        Bytes{0x20, 0x05, 0x50, 0x28, 0x18, 0x0B, 0xB8});
  const std::string version = "iNEMO Firmware_Version_2.2";
  const Bytes reply = encode_ack(Id::firmware_version, Bytes(version.begin(), version.end()));
  CHECK(Bytes(reply.begin(), reply.begin() + 3) == Bytes{0x80, 0x1B, 0x13});
}

TEST_CASE("gyro and temperature at 1 Hz, endless, is 29 00 00 00", "[frame]") {
  OutputMode mode = raw_gyro_and_temperature();
  mode.rate_code = *rate_code(1);
  mode.sample_count = 0;
  CHECK(encode_output_mode(mode) == std::array<std::uint8_t, 4>{0x29, 0x00, 0x00, 0x00});
}

TEST_CASE("the board boots with 1f 18 00 00", "[frame]") {
  CHECK(encode_output_mode(boot_mode) == std::array<std::uint8_t, 4>{0x1F, 0x18, 0x00, 0x00});
}

TEST_CASE("every output mode the firmware can hold survives its own bytes", "[frame][property]") {
  for (int sensors = 0; sensors < 256; ++sensors) {
    if ((sensors & 0x40) != 0) continue;  // compass: unused in V2
    for (int code = 0; code < 8; ++code) {
      const Bytes bytes{static_cast<std::uint8_t>(sensors), static_cast<std::uint8_t>(code << 3),
                        0x12, 0x34};
      const auto mode = decode_output_mode(bytes);
      REQUIRE(mode);
      const auto again = encode_output_mode(*mode);
      CHECK(Bytes(again.begin(), again.end()) == bytes);
    }
  }
}

TEST_CASE("an output mode with reserved bits or another length is none", "[frame]") {
  CHECK_FALSE(decode_output_mode(Bytes{0x28, 0x19, 0, 0}));
  CHECK_FALSE(decode_output_mode(Bytes{0x28, 0x58, 0, 0}));
  CHECK_FALSE(decode_output_mode(Bytes{0x28, 0x18, 0}));
  CHECK_FALSE(decode_output_mode(Bytes{}));
}

TEST_CASE("the firmware knows seven rates", "[frame]") {
  CHECK(rate_hz(0) == 1);
  CHECK(rate_hz(3) == 50);
  CHECK(rate_hz(4) == 30);
  CHECK(rate_hz(6) == 400);
  CHECK_FALSE(rate_hz(7));
  CHECK(rate_code(100) == 5);
  CHECK_FALSE(rate_code(60));
}

TEST_CASE("data frames have the bytes of the protocol", "[frame]") {
  DataFrame frame;
  frame.counter = 1;
  frame.gyro = {17, -3, 5};
  frame.temperature = 25 * 256;
  Bytes bytes;
  encode_data_frame(layout_of(raw_gyro), frame, bytes);
  CHECK(bytes == Bytes{0x40, 0x09, 0x52, 0x00, 0x01, 0x00, 0x11, 0xFF, 0xFD, 0x00, 0x05});
  bytes.clear();
  const DataLayout layout = layout_of(raw_gyro_and_temperature());
  encode_data_frame(layout, frame, bytes);
  CHECK(bytes == Bytes{0x40, 0x0B, 0x52, 0x00, 0x01, 0x00, 0x11, 0xFF, 0xFD, 0x00, 0x05, 0x19, 0});
  CHECK(decode_data_frame(layout, bytes) == frame);
}

TEST_CASE("a V2 frame of all raw sensors takes 27 bytes, 55 with AHRS", "[frame]") {
  OutputMode all = boot_mode;
  all.raw = true;
  CHECK(layout_of(all).frame_bytes == 27);
  CHECK(layout_of(all).length == 0x19);
  all.ahrs = true;
  CHECK(layout_of(all).frame_bytes == 55);
}

TEST_CASE("a frame of every sensor survives its own bytes", "[frame]") {
  OutputMode all = boot_mode;
  all.ahrs = true;
  const DataFrame frame{
      65535, {1, -2, 3}, {-4095, 4095, 0}, {7, -8, 9}, 16208, -5, {1.5F, -2, 3, 0, 1, 0, -0.5F}};
  Bytes bytes;
  encode_data_frame(layout_of(all), frame, bytes);
  CHECK(bytes.size() == 55);
  CHECK(decode_data_frame(layout_of(all), bytes) == frame);
}

TEST_CASE("a frame must be as long as its length byte says", "[frame]") {
  const Bytes good{0xC0, 0x02, 0x50, 0x02};
  const auto view = parse_frame(good);
  REQUIRE(view);
  CHECK(view->control == 0xC0);
  CHECK(view->id == 0x50);
  CHECK(view->payload.size() == 1);
  CHECK_FALSE(parse_frame(Bytes{0xC0, 0x02, 0x50}));
  CHECK_FALSE(parse_frame(Bytes{0xC0, 0x00}));
  CHECK_FALSE(parse_frame(Bytes{}));
}
