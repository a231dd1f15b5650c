#include "daemon/runner/dwell_collector.h"

#include <fmt/core.h>

#include <algorithm>
#include <utility>

#include "compensation/values/assert.h"

namespace gyrocal::runner {
namespace {

double mean_temperature_c(std::span<const BoardSample> samples) {
  std::int64_t sum = 0;
  std::int64_t count = 0;
  for (const BoardSample& sample : samples) {
    if (!sample.temperature_raw) continue;
    sum += *sample.temperature_raw;
    ++count;
  }
  return count > 0 ? double(sum) / double(count) / 256.0 : missing;
}

std::int64_t missing_between(std::span<const BoardSample> samples) {
  if (samples.empty()) return 0;
  const std::int64_t span = std::int64_t{samples.back().counter} - samples.front().counter + 1;
  return span - static_cast<std::int64_t>(samples.size());
}

}  // namespace

void DwellCollector::begin(Duration t, std::span<const std::size_t> boards) {
  GYROCAL_ASSERT(!running_);
  running_ = true;
  began_ = t;
  parts_.clear();
  for (const std::size_t board : boards) {
    parts_.emplace_back();
    parts_.back().dwell.board = board;
    parts_.back().dwell.samples.reserve(wanted_samples_);
  }
}

DwellCollector::Part* DwellCollector::part(std::size_t board) {
  const auto found = std::find_if(parts_.begin(), parts_.end(),
                                  [&](const Part& p) { return p.dwell.board == board; });
  return found == parts_.end() ? nullptr : &*found;
}

void DwellCollector::add(std::size_t board, std::span<const BoardSample> samples) {
  Part* const target = running_ ? part(board) : nullptr;
  if (!target || target->spoilt) return;
  auto& kept = target->dwell.samples;
  for (const BoardSample& sample : samples) {
    if (kept.size() == wanted_samples_) return;
    if (sample.t_ns < began_.count()) continue;
    if (!kept.empty() && sample.counter <= kept.back().counter) {
      return spoil(board, "the board started anew");
    }
    kept.push_back(sample);
  }
}

void DwellCollector::spoil(std::size_t board, const std::string& reason) {
  Part* const target = running_ ? part(board) : nullptr;
  if (!target || target->spoilt || target->dwell.samples.size() == wanted_samples_) return;
  target->spoilt = true;
  target->dwell.reject_reason = reason;
}

void DwellCollector::look_back(const Trouble& trouble) {
  for (Part& p : parts_) {
    if (p.dwell.reject_reason || p.dwell.samples.empty()) continue;
    p.dwell.reject_reason =
        trouble(Duration{p.dwell.samples.front().t_ns}, Duration{p.dwell.samples.back().t_ns});
  }
}

bool DwellCollector::full() const {
  return running_ && std::all_of(parts_.begin(), parts_.end(), [&](const Part& p) {
           return p.spoilt || p.dwell.samples.size() == wanted_samples_;
         });
}

double DwellCollector::progress() const {
  double least = 1;
  for (const Part& p : parts_) {
    if (p.spoilt) continue;
    least = std::min(least, double(p.dwell.samples.size()) / double(wanted_samples_));
  }
  return running_ ? least : 0;
}

std::optional<std::string> DwellCollector::verdict(const Part& part) const {
  if (part.dwell.reject_reason) return part.dwell.reject_reason;
  const auto lost = missing_between(part.dwell.samples);
  const auto sent = static_cast<std::int64_t>(part.dwell.samples.size()) + lost;
  if (double(lost) <= lost_share_max_ * double(sent)) return std::nullopt;
  return fmt::format("{} of {} frames missing", lost, sent);
}

std::optional<DwellCollector::Shortfall> DwellCollector::shortfall() const {
  for (const Part& p : parts_) {
    if (auto reason = verdict(p)) return Shortfall{p.dwell.board, *reason};
  }
  return std::nullopt;
}

std::vector<CollectedDwell> DwellCollector::finish(const std::optional<std::string>& reason) {
  running_ = false;
  std::vector<CollectedDwell> group;
  for (Part& p : parts_) {
    p.dwell.reject_reason = reason ? reason : verdict(p);
    p.dwell.frames_missing = missing_between(p.dwell.samples);
    p.dwell.board_mean_c = mean_temperature_c(p.dwell.samples);
    group.push_back(std::move(p.dwell));
  }
  parts_.clear();
  return group;
}

}  // namespace gyrocal::runner
