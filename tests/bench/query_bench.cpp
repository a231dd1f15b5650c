#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <filesystem>
#include <thread>

#include "schema/sqlite.h"
#include "tests/bench/child_process.h"
#include "tests/bench/sample_campaign.h"
#include "tests/bench/scratch.h"
#include "tests/bench/sections.h"
#include "tests/docs/fenced_blocks.h"

namespace gyrocal::bench {
namespace {

/// 7.5 million samples, and a slow stream of 15 hours of every board.
const CampaignShape fleet_shape{.boards = 100, .monitor_rows = 10800};
constexpr int query_rounds = 5;
constexpr double slow_s = 0.050;
constexpr double limit_s = 1.0;

struct Query {
  std::string sql;
  Spread wall_s;
  std::vector<std::string> scans;  ///< tables its plan reads from end to end
};

std::string title(const Query& query) {
  std::string text = query.sql.substr(0, 64);
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text + "...";
}

Result<std::int64_t> run_through(const Database& database, const std::string& sql) {
  auto statement = database.prepare(sql);
  if (!statement) return tl::unexpected(statement.error());
  for (std::int64_t rows = 0;; ++rows) {
    const auto more = statement->next();
    if (!more) return tl::unexpected(more.error());
    if (!*more) return rows;
  }
}

Result<std::vector<std::string>> scans_of(const Database& database, const std::string& sql) {
  auto plan = database.prepare("EXPLAIN QUERY PLAN " + sql);
  if (!plan) return tl::unexpected(plan.error());
  std::vector<std::string> scans;
  for (;;) {
    const auto more = plan->next();
    if (!more) return tl::unexpected(more.error());
    if (!*more) return scans;
    const std::string step = plan->text(3);
    if (step.starts_with("SCAN ")) scans.push_back(step.substr(5));
  }
}

Result<Query> measure(const Database& database, const std::string& sql) {
  Query query{sql, {}, {}};
  std::vector<double> wall_s;
  for (int round = 0; round < query_rounds; ++round) {
    const double before = wall_now_s();
    if (const auto ran = run_through(database, sql); !ran) return tl::unexpected(ran.error());
    wall_s.push_back(wall_now_s() - before);
  }
  query.wall_s = spread_of(std::move(wall_s));
  auto scans = scans_of(database, sql);
  if (!scans) return tl::unexpected(scans.error());
  query.scans = std::move(*scans);
  return query;
}

bool scans_samples(const Query& query) {
  return std::any_of(query.scans.begin(), query.scans.end(),
                     [](const std::string& table) { return table.starts_with("sample"); });
}

Rows summary(std::vector<Query> queries) {
  std::sort(queries.begin(), queries.end(),
            [](const Query& a, const Query& b) { return a.wall_s.median > b.wall_s.median; });
  const auto count = std::ssize(queries);
  const auto slow = std::count_if(queries.begin(), queries.end(),
                                  [](const Query& q) { return q.wall_s.median > slow_s; });
  const auto scans = std::count_if(queries.begin(), queries.end(), scans_samples);
  Rows rows{
      within(fmt::format("{} queries of docs/queries.md: the slowest, wall", count),
             queries.front().wall_s, limit_s, title(queries.front())),
      within("the same: the middle one", queries[queries.size() / 2].wall_s, slow_s, ""),
      number("the same: slower than 50 ms", fmt::format("{}", slow), "few", 2 * slow < count, ""),
      number("the same: plans that scan all samples", fmt::format("{}", scans), "0", scans == 0,
             "by EXPLAIN QUERY PLAN")};
  for (const Query& query : queries) {
    if (query.wall_s.median > slow_s) {
      rows.push_back(within("  slower than 50 ms", query.wall_s, limit_s, title(query)));
    }
  }
  return rows;
}

Rows page_rows(const std::string& path) {
  const auto database = Database::open(path, OpenMode::read_only);
  if (!database) return {failed("docs/queries.md", database.error().what)};
  std::vector<Query> queries;
  for (const FencedBlock& block : fenced_blocks(page_text("docs/queries.md"))) {
    if (block.language != "sql") continue;
    auto query = measure(*database, block.text);
    if (!query) return {failed("docs/queries.md", query.error().what)};
    queries.push_back(std::move(*query));
  }
  return summary(std::move(queries));
}

Rows write_rows(const std::string& path) {
  const std::string job = "writing 7.5 million samples of 100 boards, wall";
  const double before = wall_now_s();
  {
    auto store = Store::open(path);
    if (!store) return {failed(job, store.error().what)};
    const auto written = write_campaign(*store, fleet_shape);
    if (!written) return {failed(job, written.error().what)};
  }
  const double wall_s = wall_now_s() - before;
  return {within(job, {wall_s, wall_s, wall_s}, {},
                 fmt::format("{:.0f} MB with the slow stream; drawing the noise included",
                             static_cast<double>(std::filesystem::file_size(path)) / 1e6))};
}

Rows analysis_of_all(const std::string& path) {
  const std::string job = "analysis of 100 boards in one run, CPU a board";
  const auto ran = run_child({this_program(), "--analyse", path});
  if (!ran || ran->exit_code != 0) return {failed(job, "gyrocal_bench --analyse")};
  const double each_s = ran->cpu_s / fleet_shape.boards;
  const double cores = ran->cpu_s / ran->wall_s;
  return {
      within(job, {each_s, each_s, each_s}, 0.040, "as much as alone: linear"),
      within("the same, wall for all", {ran->wall_s, ran->wall_s, ran->wall_s}, {},
             fmt::format("{:.2f} cores busy, {:.0f} MB resident", cores, ran->memory_bytes / 1e6))};
}

/// A backup by the program while this one stores group after group into the same file.
Rows backup_rows(const std::string& path, const std::string& copy) {
  const std::string job = "backup of it while a campaign writes, wall";
  auto store = Store::open(path);
  if (!store) return {failed(job, store.error().what)};
  const CampaignShape second{.setpoints = 10000, .name = "written meanwhile"};
  std::vector<BoardId> boards;
  const auto campaign = begin_campaign(*store, second, boards);
  if (!campaign) return {failed(job, campaign.error().what)};
  std::mt19937 random(3);
  const auto samples = dwell_at(20, second.dwell_samples, random);
  std::optional<ChildResult> backup;
  std::atomic<bool> done = false;
  std::thread program([&] {
    backup = run_child({GYROCAL_PROGRAM, "db", "backup", path, copy});
    done = true;
  });
  std::vector<double> group_s;
  bool stored = true;
  for (int i = 0; !done && stored && i < second.setpoints; ++i) {
    const DwellWithSamples dwell{dwell_row(boards.front(), i, samples), samples};
    const double before = wall_now_s();
    stored = store->add_group(*campaign, std::span(&dwell, 1)).has_value();
    group_s.push_back(wall_now_s() - before);
  }
  program.join();
  if (!stored || !backup || backup->exit_code != 0) return {failed(job, "it did not go through")};
  const auto copied = Database::open(copy, OpenMode::read_only);
  const auto whole =
      copied ? copied->integer("SELECT sum(samples) = (SELECT count(*) FROM sample) FROM dwell")
             : tl::unexpected(copied.error());
  return {within(job, {backup->wall_s, backup->wall_s, backup->wall_s}, {},
                 whole && *whole == 1 ? "the copy holds every sample its dwells count"
                                      : "THE COPY IS NOT WHOLE"),
          within("the same: a group of 3000 stored meanwhile", spread_of(group_s), {},
                 fmt::format("{} groups", group_s.size()))};
}

}  // namespace

Rows query_rows() {
  const Scratch folder;
  const std::string path = folder / "large.db";
  Rows rows = write_rows(path);
  append(rows, analysis_of_all(path));
  append(rows, page_rows(path));
  append(rows, backup_rows(path, folder / "copy.db"));
  return rows;
}

}  // namespace gyrocal::bench
