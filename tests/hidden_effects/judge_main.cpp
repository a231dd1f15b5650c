// gyrocal_judge: puts hidden sessions to `gyrocal diagnose` and holds its answers against the
// truth.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <atomic>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <thread>

#include "tests/hidden_effects/judge_report.h"
#include "tests/hidden_effects/judging.h"
#include "tests/hidden_effects/run_program.h"

namespace {

namespace fs = std::filesystem;

struct Options {
  std::string gyrocal;
  std::string sessions;
  std::string only;
  std::string junit;
  unsigned jobs = 1;
  double limit_s = 300.0;
  double slack = 0.0;
  std::size_t misses = 0;
};

/// In the order of their numbers. A broken truth file ends the program: it judges nothing.
bool read_truths(const Options& options, std::vector<hidden::Truth>& truths) {
  std::error_code failed;
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(fs::path(options.sessions) / "truth", failed)) {
    if (entry.path().extension() == ".json") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  for (const auto& file : files) {
    std::string trouble;
    const auto truth = hidden::parse_truth(hidden::read_file(file), trouble);
    if (!truth) {
      std::fprintf(stderr, "%s %s\n", file.c_str(), trouble.c_str());
      return false;
    }
    if (truth->name.find(options.only) != std::string::npos) truths.push_back(*truth);
  }
  if (truths.empty()) {
    std::fprintf(stderr,
                 "no truth/*.json to judge by in %s; make some with gyrocal_hidden_sessions\n",
                 options.sessions.c_str());
  }
  return !truths.empty();
}

hidden::Judged put_to(const Options& options, const hidden::Truth& truth) {
  const fs::path base = options.sessions;
  const auto ran =
      hidden::run_program({options.gyrocal, "diagnose", "--session",
                           (base / "sessions" / truth.session).string(), "--json"},
                          base / "answers" / (truth.session + ".json"), options.limit_s);
  hidden::Answer answer;
  if (ran.trouble.empty()) answer = hidden::parse_answer(ran.output);
  if (!ran.trouble.empty()) answer.trouble = ran.trouble;
  answer.seconds = ran.seconds;
  return hidden::judge(truth, answer);
}

std::vector<hidden::Judged> put_all(const Options& options,
                                    const std::vector<hidden::Truth>& truths) {
  std::vector<hidden::Judged> judged(truths.size());
  std::atomic<std::size_t> next = 0;
  std::atomic<std::size_t> done = 0;
  const auto work = [&] {
    for (std::size_t i = next++; i < truths.size(); i = next++) {
      judged[i] = put_to(options, truths[i]);
      std::fprintf(stderr, "%zu of %zu: %s\n", ++done, truths.size(), truths[i].name.c_str());
    }
  };
  std::vector<std::thread> workers;
  for (unsigned k = 0; k < options.jobs; ++k) workers.emplace_back(work);
  for (auto& worker : workers) worker.join();
  return judged;
}

int run(const Options& options) {
  std::vector<hidden::Truth> truths;
  if (!read_truths(options, truths)) return 2;
  std::error_code failed;
  fs::create_directories(fs::path(options.sessions) / "answers", failed);
  const auto judged = put_all(options, truths);
  std::fputs(hidden::report_text(judged).c_str(), stdout);
  if (!options.junit.empty()) {
    std::ofstream out(options.junit);
    out << hidden::report_junit(judged);
    out.close();
    if (!out) {
      std::fprintf(stderr, "cannot write %s\n", options.junit.c_str());
      return 1;
    }
  }
  const auto all = hidden::targets(judged);
  const bool missed = std::any_of(all.begin(), all.end(), [&](const hidden::Target& t) {
    const double short_by = t.at_least ? t.wanted - t.value : t.value - t.wanted;
    return t.cases > 0 && short_by > options.slack && t.culprits.size() > options.misses;
  });
  return missed ? 1 : 0;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{
      "Example: gyrocal_judge --gyrocal build/release/gyrocal --sessions /tmp/hidden --jobs 2"};
  Options options;
  app.add_option("--gyrocal", options.gyrocal, "the program to judge")->required();
  app.add_option("--sessions", options.sessions, "what gyrocal_hidden_sessions wrote")->required();
  app.add_option("--only", options.only, "cases with this in their name");
  app.add_option("--jobs", options.jobs, "sessions judged at once")
      ->check(CLI::Range(1u, 64u))
      ->capture_default_str();
  app.add_option("--limit-s", options.limit_s, "a session that takes longer counts as unanswered")
      ->capture_default_str();
  app.add_option("--slack", options.slack,
                 "exit 0 where each missed target is missed by no more than this share")
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str();
  app.add_option("--misses", options.misses,
                 "exit 0 where no more sessions than this count against a target (a small set)")
      ->capture_default_str();
  app.add_option("--junit", options.junit, "write targets and sessions as JUnit XML");
  CLI11_PARSE(app, argc, argv);
  return run(options);
}
