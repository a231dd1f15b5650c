/// Campaign files, mutated: each is refused with its place, or is one whose every number a campaign
/// can be run with.

#include <cmath>
#include <fstream>
#include <iterator>
#include <set>

#include "compensation/values/assert.h"
#include "config/campaign.h"
#include "tests/fuzz/loop.h"

using namespace gyrocal;

namespace {

const std::string source = GYROCAL_SOURCE_DIR;

std::string file(const std::string& path) {
  std::ifstream in(source + path, std::ios::binary);
  GYROCAL_ASSERT(in.good());
  return {std::istreambuf_iterator<char>(in), {}};
}

const ChamberProfile& profile() {
  static const auto parsed =
      parse_chamber_profile(file("/config/chambers/yinhe.toml"), "yinhe.toml").value();
  return parsed;
}

fuzz::Bytes bytes_of(const std::string& text) { return {text.begin(), text.end()}; }

std::vector<fuzz::Bytes> seeds() {
  return {bytes_of(file("/config/campaigns/demo.toml")),
          bytes_of(file("/config/campaigns/weekend.toml"))};
}

/// One value of the file replaced by one that people and programs get wrong.
std::string with_odd_value(std::string text, std::mt19937_64& random) {
  constexpr const char* odd[] = {"nan", "-inf",  "1e999", "-1",          "9223372036854775807",
                                 "0",   "\"\"",  "[]",    "{}",          "[[1]]",
                                 "0.1", "1e-30", "true",  "\"\\u0000\"", "1979-05-27"};
  const auto from = text.find('=', random() % (text.size() + 1));
  if (from == std::string::npos) return text;
  const auto end = std::min(text.find('\n', from), text.size());
  return text.replace(from + 1, end - from - 1, odd[random() % std::size(odd)]);
}

void check_config(const CampaignConfig& config) {
  GYROCAL_ASSERT(!config.name.empty() && !config.boards.empty() && !config.plan.setpoints.empty());
  const SetpointRange allowed = allowed_setpoints(config);
  for (const Celsius setpoint : config.plan.setpoints) {
    GYROCAL_ASSERT(setpoint >= allowed.min && setpoint <= allowed.max);  // NaN is neither
  }
  GYROCAL_ASSERT(config.plan.safe_setpoint >= allowed.min);
  GYROCAL_ASSERT(config.plan.safe_setpoint <= allowed.max);
  GYROCAL_ASSERT(config.plan.ramp_per_minute.value > 0 && config.plan.samples_per_setpoint > 0);
  GYROCAL_ASSERT(config.chamber.poll_interval_s > 0 && config.chamber.reply_timeout_s > 0);
  GYROCAL_ASSERT(config.time_scale > 0 && std::isfinite(config.time_scale));
  GYROCAL_ASSERT(config.simulated || config.time_scale == 1);
  GYROCAL_ASSERT(config.stability.soak_s_max >= config.stability.soak_s_min);
  GYROCAL_ASSERT(config.limits.dwell_attempts_max >= 1);
  std::set<std::string> names;
  for (const BoardConfig& board : config.boards) {
    GYROCAL_ASSERT(names.insert(board.name).second);
    for (const double scale : board.lsb_per_dps) GYROCAL_ASSERT(scale > 0 && std::isfinite(scale));
  }
}

void check(const fuzz::Bytes& bytes, std::mt19937_64& random) {
  std::string text(bytes.begin(), bytes.end());
  if (random() % 2 == 0) text = with_odd_value(text, random);
  const auto config = parse_campaign(text, "/fuzz/campaign.toml", profile());
  if (config) {
    GYROCAL_ASSERT(config->text == text);
    return check_config(*config);
  }
  GYROCAL_ASSERT(config.error().what.find("/fuzz/campaign.toml") != std::string::npos);
}

}  // namespace

int main(int argc, char** argv) {
  // Half the inputs are whole but for a value: most mutations of bytes only break the syntax.
  auto all = seeds();
  return fuzz::run(argc, argv, all, [&](const fuzz::Bytes& bytes, std::mt19937_64& random) {
    const auto& whole = all[random() % all.size()];
    check(random() % 2 == 0 ? whole : bytes, random);
  });
}
