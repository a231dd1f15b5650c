#include <fmt/core.h>

#include <nlohmann/json.hpp>

#include "daemon/replay/replay.h"
#include "daemon/runner/progress.h"

namespace gyrocal::replay {
namespace {

using Json = nlohmann::ordered_json;

std::string text_of(const ReplayedRun& run) {
  std::string text = fmt::format(
      "run {} ({}), recorded by {}: {}\n"
      "  alike: {} requests, {} writes, {} bytes read; {} decisions, {} dwells, {} samples,\n"
      "  {} rows of the slow stream, {} models\n",
      run.number,
      run.campaign ? runner::clock_text(run.from) + " to " + runner::clock_text(run.to)
                   : "preflight did not pass",
      run.software_version, run.ended.empty() ? "not to its end" : run.ended, run.passed.requests,
      run.passed.writes, run.passed.bytes_read, run.decisions, run.dwells, run.samples,
      run.monitor_rows, run.models);
  if (run.cut_off) {
    text += fmt::format(
        "  the recording ends at {}, before the run did; {} rows stored later are not checked\n",
        runner::clock_text(run.to), run.unchecked_rows);
  }
  return text;
}

Json json_of(const ReplayedRun& run) {
  Json json{{"run", run.number},           {"software_version", run.software_version},
            {"campaign", nullptr},         {"from_s", to_seconds(run.from)},
            {"to_s", to_seconds(run.to)},  {"ended", run.ended},
            {"cut_off", run.cut_off},      {"requests", run.passed.requests},
            {"writes", run.passed.writes}, {"bytes_read", run.passed.bytes_read},
            {"decisions", run.decisions},  {"dwells", run.dwells},
            {"samples", run.samples},      {"monitor_rows", run.monitor_rows},
            {"models", run.models},        {"unchecked_rows", run.unchecked_rows}};
  if (run.campaign) json["campaign"] = *run.campaign;
  return json;
}

Json json_of(const Difference& difference) {
  return {{"run", difference.run},   {"t_s", to_seconds(difference.t)},
          {"what", difference.what}, {"expected", difference.expected},
          {"got", difference.got},   {"sentence", difference.sentence}};
}

}  // namespace

std::string report_text(const ReplayReport& report) {
  std::string text = fmt::format("{} against {}\n", report.recording, report.against);
  for (const ReplayedRun& run : report.runs) text += text_of(run);
  if (report.difference) {
    text +=
        fmt::format("DIFFERS in run {}: {}\n", report.difference->run, report.difference->sentence);
  }
  text += report.repeatable ? "Replayed twice, alike to the last bit.\n"
                            : "DIFFERS: two replays of the same recording are not alike.\n";
  return text;
}

std::string report_json(const ReplayReport& report, const std::string& software_version) {
  Json json{{"format", "gyrocal-replay/1"}, {"recording", report.recording},
            {"against", report.against},    {"software_version", software_version},
            {"passed", report.passed()},    {"repeatable", report.repeatable},
            {"first_difference", nullptr},  {"runs", Json::array()}};
  if (report.difference) json["first_difference"] = json_of(*report.difference);
  for (const ReplayedRun& run : report.runs) json["runs"].push_back(json_of(run));
  return json.dump(2);
}

}  // namespace gyrocal::replay
