#pragma once

#include <array>
#include <bit>
#include <cstdint>

namespace gyrocal::rig {

/// What a stream of random numbers is for. Streams of different keys are independent, so adding an
/// effect, a board or an axis changes nothing in the noise of the others.
struct StreamKey {
  std::uint64_t seed = 0;
  std::uint32_t board = 0;  ///< board index; 0 also for what all boards share
  std::uint32_t axis = 0;   ///< 0 x, 1 y, 2 z; 0 also for what all axes share
  std::uint32_t purpose =
      0;  ///< a StreamPurpose, or first_effect + the effect's place in the model
};
enum StreamPurpose : std::uint32_t {
  white_noise = 0,
  board_spread = 1,
  accelerometer = 2,
  plan_order = 3,
  wire_faults = 4,
  first_effect = 16
};

/// xoshiro256++ (Blackman, Vigna 2019), seeded through splitmix64. Same numbers on every machine.
class RandomStream {
 public:
  explicit RandomStream(const StreamKey& key);

  std::uint64_t bits() {
    const std::uint64_t result = std::rotl(state_[0] + state_[3], 23) + state_[0];
    const std::uint64_t shifted = state_[1] << 17;
    state_[2] ^= state_[0];
    state_[3] ^= state_[1];
    state_[1] ^= state_[2];
    state_[0] ^= state_[3];
    state_[2] ^= shifted;
    state_[3] = std::rotl(state_[3], 45);
    return result;
  }
  /// Uniform in (0, 1), never 0 or 1.
  double uniform() { return (static_cast<double>(bits() >> 12) + 0.5) * 0x1p-52; }
  /// Standard normal deviate, by the ziggurat of 256 layers (Marsaglia, Tsang 2000).
  double normal();
  /// Exponential deviate of mean 1.
  double exponential();

 private:
  double normal_outside_the_layers(std::uint64_t layer, double x);
  std::array<std::uint64_t, 4> state_;
};

/// The ziggurat's layers: x edges, and what a 53-bit integer is multiplied with and compared to.
struct ZigguratTable {
  std::array<double, 257> edge;
  std::array<double, 257> height;
  std::array<double, 256> width;
  std::array<std::uint64_t, 256> inside;
};
const ZigguratTable& ziggurat_table();

}  // namespace gyrocal::rig
