#include "daemon/replay/run_replay.h"

#include <fmt/core.h>

#include <charconv>
#include <memory>

#include "config/text_file.h"
#include "daemon/replay/recorded_span.h"
#include "daemon/replay/row_check.h"
#include "daemon/runner/after_trip.h"
#include "schema/campaign_slice.h"
#include "schema/compare_campaigns.h"
#include "schema/open_database.h"

namespace gyrocal::replay {
namespace {

/// One run on its way.
class Replaying {
 public:
  Replaying(const RunMaterial& material, std::unique_ptr<ReplayDevices> devices, Database recorded)
      : material_(material),
        devices_(std::move(devices)),
        tape_(devices_->tape()),
        recorded_(std::move(recorded)),
        decisions_(tape_) {}

  Result<RunResult> run();

 private:
  [[nodiscard]] runner::RunHooks hooks();
  void begin(CampaignId campaign, Duration t);
  [[nodiscard]] std::string repeat();
  void complete_trip();
  [[nodiscard]] Result<void> expect_recorded(CampaignId campaign);
  [[nodiscard]] Result<void> may_store();
  void end(const std::string& now);
  [[nodiscard]] Result<void> compare_rows();
  [[nodiscard]] std::int64_t after_ns() const;

  const RunMaterial& material_;
  std::unique_ptr<ReplayDevices> devices_;
  Tape& tape_;
  Database recorded_;
  std::optional<Store> store_;  ///< the replay's, while it runs
  DecisionCheck decisions_;
  std::optional<CampaignId> campaign_;  ///< in the replay's database
  std::optional<Error> trouble_;
  RunResult result_;
};

std::int64_t Replaying::after_ns() const {
  return material_.begun.resumed ? material_.begun.resumed->t_last_ns
                                 : std::numeric_limits<std::int64_t>::min();
}

void Replaying::begin(CampaignId campaign, Duration t) {
  campaign_ = campaign;
  const Instant origin = tape_.now() - t;
  tape_.count_from(origin);
  result_.run.from = t;
  const auto told = tape_.input(runner::input::begun);
  if (!told) return;  // shows in the tape
  const auto then = begun_from(*told);
  if (!then) {
    trouble_ = then.error();
    return;
  }
  if (const auto right = expect_recorded(CampaignId{then->campaign}); !right) {
    trouble_ = right.error();
    return;
  }
  result_.run.campaign = then->campaign;
  auto events = events_in({recorded_, CampaignId{then->campaign}, after_ns()});
  if (!events) {
    trouble_ = events.error();
    return;
  }
  decisions_.begin(origin, std::move(*events));
}

/// That the database to compare with holds the recorded campaign, and not one of the same number.
Result<void> Replaying::expect_recorded(CampaignId campaign) {
  const auto ours = store_->campaign(*campaign_);
  if (!ours) return tl::unexpected(ours.error());
  auto theirs = recorded_.prepare("SELECT utc_start_ns FROM campaign WHERE id = ?");
  if (!theirs) return tl::unexpected(theirs.error());
  theirs->bind(0, static_cast<std::int64_t>(campaign));
  const auto found = theirs->next();
  if (!found) return tl::unexpected(found.error());
  if (*found && theirs->integer(0) == ours->utc_start_ns) return {};
  return fail(Errc::mismatch,
              fmt::format("{}: its campaign {} is not the campaign that was recorded",
                          material_.against, static_cast<std::int64_t>(campaign)),
              "--against says which database the recorded campaign wrote");
}

Result<void> Replaying::may_store() {
  if (trouble_) return tl::unexpected(*trouble_);
  if (const auto failed = tape_.input_if(runner::input::not_stored)) {
    decisions_.not_stored();
    return fail(Errc::storage, *failed);
  }
  if (!tape_.over() && !decisions_.differs()) return {};
  return fail(Errc::storage, "the replay ends here");
}

runner::RunHooks Replaying::hooks() {
  runner::RunHooks hooks;
  hooks.stop_asked = [this] {
    return tape_.over() || tape_.input_if(runner::input::stop).has_value();
  };
  hooks.next_command = [this]() -> std::optional<campaign::Event> {
    const auto text = tape_.input_if(runner::input::command);
    return text ? runner::command_named(*text) : std::nullopt;
  };
  hooks.bytes_free = [this]() -> std::optional<std::uintmax_t> {
    const auto text = tape_.input(runner::input::bytes_free);
    std::uintmax_t bytes = 0;
    if (!text ||
        std::from_chars(text->data(), text->data() + text->size(), bytes).ec != std::errc{})
      return std::nullopt;
    return bytes;
  };
  hooks.begun = [this](CampaignId campaign, Duration t) { begin(campaign, t); };
  hooks.log = [this](const EventInsert& event) { decisions_.decided(event); };
  hooks.storing.may_store = [this] { return may_store(); };
  return hooks;
}

/// A run that told a chamber after a trip has no journal but the one line it ends with.
void Replaying::complete_trip() {
  const auto& resumed = *material_.begun.resumed;
  campaign_ = CampaignId{resumed.campaign};
  result_.run.campaign = resumed.campaign;
  result_.run.from = Duration{resumed.t_last_ns};
  decisions_.begin(tape_.now() - result_.run.from, {});
  tape_.count_from(decisions_.origin());
  static_cast<void>(tape_.input(runner::input::begun));  // shows in the tape if it is not there
}

/// The run itself. @return how it ended.
std::string Replaying::repeat() {
  const auto& options = material_.begun.options;
  auto devices = devices_->devices();
  if (!material_.begun.completes_trip || !material_.begun.resumed) {
    return runner::ended_text(
        runner::run_campaign(material_.config, devices, *store_, options, hooks()));
  }
  complete_trip();
  return runner::ended_text(runner::complete_trip(
      material_.config, *store_, *campaign_, devices.chamber, devices.clock, options.stop_within));
}

void Replaying::end(const std::string& now) {
  if (decisions_.differs()) return;
  if (tape_.ended()) {
    result_.run.cut_off = true;
    return;
  }
  const auto recorded = tape_.input(runner::input::ended);
  if (!recorded) return;  // it went on: shows in the tape
  result_.run.ended = *recorded;
  if (now == *recorded) return;
  result_.difference = {
      0,
      tape_.now() - decisions_.origin(),
      "end",
      *recorded,
      now,
      fmt::format("the recorded run ended with \"{}\", the replay with \"{}\"", *recorded, now)};
}

Result<void> Replaying::compare_rows() {
  const auto replayed = open_to_read(material_.database);
  if (!replayed) return tl::unexpected(replayed.error());
  const RowCheck check{{recorded_, CampaignId{*result_.run.campaign}, after_ns()},
                       {*replayed, *campaign_, after_ns()},
                       tape_.reached() - decisions_.origin(),
                       material_.next};
  return check_rows(check, result_);
}

Result<RunResult> Replaying::run() {
  auto store = Store::open(material_.database);
  if (!store) return tl::unexpected(store.error());
  store_.emplace(std::move(*store));
  end(repeat());
  store_.reset();
  if (trouble_) return tl::unexpected(*trouble_);
  result_.run.number = material_.run.id;
  result_.run.software_version = material_.run.software_version;
  result_.run.to = tape_.reached() - decisions_.origin();
  result_.run.passed = tape_.counts();
  result_.run.decisions = decisions_.alike();
  if (auto first = decisions_.first(result_.run.cut_off)) result_.difference = std::move(first);
  if (result_.run.campaign) {
    if (auto compared = compare_rows(); !compared) return tl::unexpected(compared.error());
  }
  if (result_.difference) result_.difference->run = material_.run.id;
  if (!result_.difference && tape_.trouble()) {
    Error trouble = *tape_.trouble();
    trouble.what = fmt::format("{}: run {}, after {:.0f} s: {}", material_.recording,
                               material_.run.id, to_seconds(result_.run.to), trouble.what);
    return tl::unexpected(trouble);
  }
  return std::move(result_);
}

/// What stood in the database when the run began; nothing for a new campaign.
Result<void> prepare_database(const RunMaterial& material) {
  if (!material.begun.resumed) return {};
  const auto& resumed = *material.begun.resumed;
  return cut_out_campaign(
      material.against, material.database,
      {CampaignId{resumed.campaign}, resumed.t_last_ns, resumed.state, material.config.text});
}

}  // namespace

Result<RunMaterial> material_of(const std::string& recording, const RecordedRun& run,
                                const std::optional<std::string>& campaign) {
  auto begun = runner::circumstances_from(run.circumstances);
  if (!begun) return tl::unexpected(begun.error());
  const auto profile = parse_chamber_profile(begun->chamber_profile, "recorded chamber profile");
  if (!profile) return tl::unexpected(profile.error());
  auto text = campaign ? read_text_file(*campaign) : run.campaign_text;
  if (!text) return tl::unexpected(text.error());
  auto config = parse_campaign(*text, campaign.value_or("recorded campaign"), *profile);
  if (!config) return tl::unexpected(config.error());
  RunMaterial material;
  material.recording = recording;
  material.run = run;
  material.config = std::move(*config);
  material.begun = std::move(*begun);
  return material;
}

Result<RunResult> replay_run(const RunMaterial& material) {
  auto recorded = open_to_read(material.against);
  if (!recorded) return tl::unexpected(recorded.error());
  if (auto ready = prepare_database(material); !ready) return tl::unexpected(ready.error());
  auto devices =
      ReplayDevices::open(material.recording, material.run, material.config, material.begun);
  if (!devices) return tl::unexpected(devices.error());
  return Replaying(material, std::move(*devices), std::move(*recorded)).run();
}

}  // namespace gyrocal::replay
