#include "daemon/runner/run_recording.h"

#include <fmt/core.h>

#include <array>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <utility>

namespace gyrocal::runner {
namespace {

constexpr char format[] = "gyrocal-run/1";

const std::array<std::pair<const char*, campaign::Event>, 4>& commands() {
  static const std::array<std::pair<const char*, campaign::Event>, 4> all{{
      {"pause", campaign::PauseAsked{}},
      {"resume", campaign::ResumeAsked{}},
      {"skip", campaign::SkipAsked{}},
      {"abort", campaign::AbortAsked{}},
  }};
  return all;
}

Circumstances parsed(const nlohmann::json& json) {
  Circumstances c;
  c.in_virtual_time = json.at("in_virtual_time").get<bool>();
  c.chamber_profile = json.at("chamber_profile").get<std::string>();
  const auto duration = [&](const char* key) {
    return Duration{json.at(key).get<Duration::rep>()};
  };
  c.options.software_version = json.at("software_version").get<std::string>();
  c.options.tick = duration("tick_ns");
  c.options.patience = duration("patience_ns");
  c.options.stop_within = duration("stop_within_ns");
  c.options.monitor_rows_per_write = json.at("monitor_rows_per_write").get<std::size_t>();
  c.options.utc_rate = json.at("utc_rate").get<double>();
  c.options.resume = json.at("resume").get<bool>();
  c.completes_trip = json.value("completes_trip", false);  // younger than the format
  if (json.contains("resumed")) {
    const auto& resumed = json.at("resumed");
    c.resumed = {resumed.at("campaign").get<std::int64_t>(), resumed.at("state").get<std::string>(),
                 resumed.at("t_last_ns").get<std::int64_t>()};
  }
  return c;
}

}  // namespace

std::string recording_path(const std::string& database) {
  const std::filesystem::path path(database);
  const auto name = path.extension() == ".db" ? path.stem() : path.filename();
  return (path.parent_path() / (name.string() + ".recording.db")).string();
}

std::string to_json(const Circumstances& c) {
  nlohmann::ordered_json json{
      {"format", format},
      {"in_virtual_time", c.in_virtual_time},
      {"software_version", c.options.software_version},
      {"tick_ns", c.options.tick.count()},
      {"patience_ns", c.options.patience.count()},
      {"stop_within_ns", c.options.stop_within.count()},
      {"monitor_rows_per_write", c.options.monitor_rows_per_write},
      {"utc_rate", c.options.utc_rate},
      {"resume", c.options.resume},
      {"completes_trip", c.completes_trip},
      {"chamber_profile", c.chamber_profile},
  };
  if (c.resumed) {
    json["resumed"] = {{"campaign", c.resumed->campaign},
                       {"state", c.resumed->state},
                       {"t_last_ns", c.resumed->t_last_ns}};
  }
  return json.dump();
}

Result<Circumstances> circumstances_from(const std::string& text) {
  const auto unknown = fail(Errc::bad_frame, "the recording does not say how its run was begun",
                            "the file is damaged, or of a newer version");
  try {
    const auto json = nlohmann::json::parse(text);
    if (json.at("format").get<std::string>() != format) return unknown;
    return parsed(json);
  } catch (const nlohmann::json::exception&) {
    return unknown;
  }
}

std::string command_text(const campaign::Event& command) {
  for (const auto& [text, event] : commands()) {
    if (event.index() == command.index()) return text;
  }
  return {};
}

std::optional<campaign::Event> command_named(const std::string& text) {
  for (const auto& [name, event] : commands()) {
    if (name == text) return event;
  }
  return std::nullopt;
}

std::string begun_text(CampaignId campaign, Duration t) {
  return fmt::format("{} {}", static_cast<std::int64_t>(campaign), t.count());
}

std::string ended_text(const Result<void>& completed) {
  return completed ? "safe, completed" : to_text(completed.error());
}

std::string ended_text(const Result<Outcome>& outcome) {
  if (!outcome) return to_text(outcome.error());
  const std::string state = campaign::name(outcome->state);
  if (outcome->stopped) return "stopped while " + state;
  if (const auto* safe = std::get_if<campaign::Safe>(&outcome->state)) {
    return state + ": " + safe->why;
  }
  return state;
}

RunHooks recorded_hooks(RunHooks hooks, Recorder& recorder) {
  RunHooks recorded = hooks;
  recorded.stop_asked = [asked = hooks.stop_asked, &recorder] {
    const bool stop = asked && asked();
    if (stop) recorder.input(input::stop, {});
    return stop;
  };
  recorded.next_command = [next = hooks.next_command, &recorder] {
    auto command = next ? next() : std::nullopt;
    if (command) recorder.input(input::command, command_text(*command));
    return command;
  };
  recorded.bytes_free = [free = hooks.bytes_free, &recorder] {
    const auto bytes = free ? free() : std::nullopt;
    recorder.input(input::bytes_free, bytes ? std::to_string(*bytes) : std::string{});
    return bytes;
  };
  recorded.begun = [told = hooks.begun, &recorder](CampaignId campaign, Duration t) {
    recorder.input(input::begun, begun_text(campaign, t));
    if (told) told(campaign, t);
  };
  recorded.storing.not_stored = [told = hooks.storing.not_stored, &recorder](const Error& error) {
    recorder.input(input::not_stored, to_text(error));
    if (told) told(error);
  };
  return recorded;
}

RunRecording::RunRecording(const std::string& database, const RecordedRun& run,
                           Duration flush_every) {
  auto writer = RecordingWriter::open(recording_path(database), run, flush_every);
  if (writer) {
    writer_ = std::move(*writer);
  } else {
    trouble_ = writer.error();
  }
}

std::optional<Error> RunRecording::trouble() {
  const std::optional<Error>& trouble = writer_ ? writer_->trouble() : trouble_;
  if (!trouble || std::exchange(told_, true)) return std::nullopt;
  return trouble;
}

}  // namespace gyrocal::runner
