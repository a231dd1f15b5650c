#pragma once

#include <algorithm>
#include <catch2/catch.hpp>
#include <deque>
#include <functional>
#include <map>
#include <utility>
#include <vector>

#include "daemon/runner/campaign_runner.h"
#include "daemon/runner/run_request.h"
#include "drivers/board/inemo_board.h"
#include "drivers/chamber/modbus_chamber.h"
#include "drivers/clocks.h"
#include "drivers/simulated/in_process_links.h"
#include "drivers/simulated/simulated_rig.h"
#include "tests/daemon/runner/temporary_folder.h"

namespace gyrocal::runner {

/// A Modbus link that can be cut and mended.
class CuttableLink final : public RequestLink {
 public:
  CuttableLink(RequestLink& target, Clock& clock) : target_(target), clock_(clock) {}
  Result<Bytes> transact(std::span<const std::uint8_t> request) override {
    ++requests;
    if (!cut) return target_.transact(request);
    clock_.sleep_until(clock_.now() + std::chrono::seconds{1});
    return fail(Errc::timeout, "no reply in 1 s", "is the chamber on?");
  }
  bool cut = false;
  int requests = 0;

 private:
  RequestLink& target_;
  Clock& clock_;
};

/// A chamber whose readings are tampered with on the way.
class DoctoredChamber final : public Chamber {
 public:
  explicit DoctoredChamber(Chamber& target) : target_(target) {}
  Result<ChamberReading> read() override {
    auto reading = target_.read();
    if (reading && doctor) doctor(*reading);
    return reading;
  }
  Result<void> set_setpoint(Celsius to) override {
    written.push_back(to.value);
    return target_.set_setpoint(to);
  }
  Result<void> run() override { return target_.run(); }
  Result<void> stop() override { return target_.stop(); }

  std::function<void(ChamberReading&)> doctor;
  std::vector<double> written;

 private:
  Chamber& target_;
};

/// A short campaign in virtual time on the simulated rig, with somebody who meddles at given times.
class VirtualBench {
 public:
  explicit VirtualBench(const std::string& text, const rig::RigModel& model = {},
                        std::uint64_t seed = 1)
      : config(parsed(text)),
        rig(model, seed, config.boards.size(), config.chamber.profile, config.chamber.unit),
        chamber_wire_(rig.chamber(), clock, seconds(1)),
        link(chamber_wire_, clock),
        modbus_(link, clock, config.chamber.profile, config.chamber.unit),
        chamber(modbus_),
        store(*Store::open(folder_ / "bench.db")) {
    for (std::size_t i = 0; i < config.boards.size(); ++i) {
      board_wires_.emplace_back(rig.board(i), clock);
      boards_.emplace_back(board_wires_.back(), clock);
    }
  }

  /// `deed` is done once, at the first turn of the loop at or after t.
  void at(double t_s, std::function<void()> deed) { deeds_.emplace(t_s, std::move(deed)); }
  /// `deed` is done once, at the first turn in that state (of that setpoint, 0-based).
  void when(const std::string& state, std::size_t point, std::function<void(Duration)> deed) {
    awaited_.push_back({state, point, std::move(deed)});
  }

  Outcome run() {
    RunOptions options = virtual_options(config);
    options.software_version = "test";
    options.resume = true;
    RunHooks hooks;
    hooks.log = [&](const EventInsert& event) {
      ++events[event.kind];
      seen_s[event.kind] = double(event.t_ns) * 1e-9;
      if (event.text.find("-> safe") != std::string::npos)
        seen_s["trip"] = double(event.t_ns) * 1e-9;
      texts.push_back(event.kind + ": " + event.text);
    };
    hooks.progress = [&](const Snapshot& now) { meddle(now); };
    std::vector<Board*> boards;
    for (auto& board : boards_) boards.push_back(&board);
    const auto outcome = run_campaign(config, {clock, chamber, boards}, store, options, hooks);
    if (!outcome) FAIL(to_text(outcome.error()));
    return *outcome;
  }

  [[nodiscard]] std::size_t accepted(CampaignId campaign) const {
    std::size_t count = 0;
    const auto boards = store.boards(campaign);
    for (const auto& [id, board] : *boards) {
      count += store.accepted_dwells(campaign, id)->size();
    }
    return count;
  }

  /// Some event's text holds `part`.
  [[nodiscard]] bool said(const std::string& part) const {
    return std::any_of(texts.begin(), texts.end(), [&](const std::string& text) {
      return text.find(part) != std::string::npos;
    });
  }

  CampaignConfig config;
  VirtualClock clock;
  SimulatedRig rig;

 private:
  TemporaryFolder folder_;
  InProcessChamberLink chamber_wire_;

 public:
  CuttableLink link;

 private:
  ModbusChamber modbus_;

 public:
  DoctoredChamber chamber;
  Store store;
  std::map<std::string, int> events;     ///< how many of each kind
  std::map<std::string, double> seen_s;  ///< when the last of each kind was; "trip" when it tripped
  std::vector<std::string> texts;

 private:
  struct Awaited {
    std::string state;
    std::size_t point;
    std::function<void(Duration)> deed;
  };

  static CampaignConfig parsed(const std::string& text) {
    auto config =
        parse_campaign(text, std::string(GYROCAL_SOURCE_DIR) + "/config/campaigns/bench.toml");
    if (!config) FAIL(to_text(config.error()));
    return *config;
  }

  void meddle(const Snapshot& now) {
    while (!deeds_.empty() && deeds_.begin()->first <= to_seconds(now.t)) {
      const auto deed = deeds_.begin()->second;
      deeds_.erase(deeds_.begin());
      deed();
    }
    for (auto& awaited : awaited_) {
      if (!awaited.deed || now.state != awaited.state || now.setpoints_done != awaited.point) {
        continue;
      }
      std::exchange(awaited.deed, nullptr)(now.t);
    }
  }

  std::deque<InProcessBoardLink> board_wires_;
  std::deque<InemoBoard> boards_;
  std::multimap<double, std::function<void()>> deeds_;
  std::vector<Awaited> awaited_;
};

/// Five setpoints, two boards, dwells of a minute at 10 Hz.
inline const std::string short_campaign = R"([campaign]
name = "bench"
simulated = true
[plan]
setpoints_c = [10, 18, 26, 34, 42]
samples_per_setpoint = 600
sample_rate_hz = 10
ramp_k_per_min = 1
safe_setpoint_c = 25
[chamber]
profile = "yinhe"
host = "127.0.0.1"
[[board]]
name = "left"
device = "/dev/left"
[[board]]
name = "right"
device = "/dev/right"
[stability]
air_window_s = 240
air_peak_to_peak_k = 0.4
board_window_s = 300
soak_s_min = 600
)";

}  // namespace gyrocal::runner
