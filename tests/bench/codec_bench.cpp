#include <fmt/format.h>

#include <array>
#include <cmath>
#include <fstream>
#include <optional>

#include "daemon/runner/dwell_collector.h"
#include "daemon/runner/slow_stream.h"
#include "tests/bench/canned_board.h"
#include "tests/bench/python_peer.h"
#include "tests/bench/scratch.h"
#include "tests/bench/sections.h"

namespace gyrocal::bench {
namespace {

constexpr std::size_t frames = 200'000;
constexpr BoardMode codec_mode{400, false, true};

/// Bytes to samples to the dwell and the slow stream they belong to, as the daemon's loop does it.
/// @return CPU time of a frame; not a number if a frame was lost.
double cpu_of_frame_s(const Bytes& bytes, std::size_t frames_a_read) {
  CannedBoard canned(codec_mode);
  if (!canned.started()) return NAN;
  const std::size_t frame_bytes = bytes.size() / frames;
  canned.link().play(bytes, frames_a_read * frame_bytes);
  runner::DwellCollector dwell(static_cast<int>(frames), 0.01);
  runner::SlowStream slow(seconds(5), canned.clock().now().time_since_epoch());
  dwell.begin(canned.clock().now().time_since_epoch(), std::array<std::size_t, 1>{0});
  std::vector<BoardSample> fresh;
  std::size_t taken = 0;
  const Duration turn = seconds(static_cast<double>(frames_a_read) / codec_mode.sample_rate_hz);
  const double before = cpu_now_s();
  while (!canned.link().ended()) {
    canned.clock().sleep_until(canned.clock().now() + turn);
    fresh.clear();
    if (!canned.board().drain(fresh)) return NAN;
    dwell.add(0, fresh);
    slow.add(fresh);
    taken += fresh.size();
  }
  const double cpu_s = cpu_now_s() - before;
  const bool whole = taken + 1 >= frames && canned.board().tally().missing == 0;  // the last waits
  return whole ? cpu_s / static_cast<double>(frames) : NAN;
}

/// Absent if frames were lost.
std::optional<Spread> measure(const Bytes& bytes, std::size_t frames_a_read) {
  std::vector<double> taken;
  for (int i = 0; i < 9; ++i) {
    taken.push_back(cpu_of_frame_s(bytes, frames_a_read));
    if (std::isnan(taken.back())) return std::nullopt;
  }
  return spread_of(std::move(taken));
}

Peer script(const Bytes& bytes) {
  const Scratch folder;
  const std::string file = folder / "frames";
  std::ofstream(file, std::ios::binary)
      .write(reinterpret_cast<const char*>(bytes.data()), std::ssize(bytes));
  const auto python = ask_python("frames_peer.py", {file});
  Peer peer{"Python struct", {}, "python3"};
  if (python) peer.took_s = spread_from(python->at("cpu_s"));
  return peer;
}

}  // namespace

Rows codec_rows() {
  const std::string job = "codec and dispatch of a frame";
  const Bytes bytes = frames_on_wire(codec_mode, frames);
  const auto few = measure(bytes, 8);
  const auto many = measure(bytes, 250);
  if (!few || !many) return {failed(job, "frames were lost")};
  return {within(job + ", 8 a read", *few, 1e-6, "driver, dwell and slow stream; none lost"),
          within(job + ", 250 a read", *many, 1e-6, "as in virtual time"),
          against("the same, 8 a read, beside a script", *few, script(bytes), {},
                  "as scripts treat what pyserial reads")};
}

}  // namespace gyrocal::bench
