// A campaign on real endpoints, with everything against it that a page and its messages can do.
#include <atomic>
#include <deque>
#include <map>
#include <thread>

#include "daemon/runner/run_request.h"
#include "daemon/status/status_page.h"
#include "tests/daemon/runner/served_rig.h"
#include "tests/daemon/status/http_client.h"

namespace gyrocal::status {

SCENARIO("a campaign does not notice floods, deaf and slow clients of its page") {
  using namespace runner;
  const TemporaryFolder folder;
  const ServedRig rig(folder);
  RunRequest request;
  request.campaign_path = folder.write("wired.toml", campaign_text(folder, rig.port()));
  const auto config = read_campaign(request.campaign_path);
  REQUIRE(config);
  const int port = free_port();
  auto page = StatusPage::start({true, "127.0.0.1", port},
                                facts_of(*config, request.campaign_path, config->database, "test"));
  if (!page) FAIL(to_text(page.error()));

  std::atomic<bool> over = false;
  std::atomic<int> answers = 0;
  std::deque<Client> hanging;
  for (int i = 0; i < 400; ++i) {
    hanging.emplace_back(port);
    hanging.back().say(i % 2 == 0 ? "GET /api/stream HTTP/1.1\r\n\r\n" : "GET / HT");
  }
  std::vector<std::thread> crowd;
  for (int i = 0; i < 8; ++i) {
    crowd.emplace_back([&] {
      while (!over) {
        if (get(port, "/").find("200 OK") != std::string::npos) ++answers;
      }
    });
  }
  std::map<std::string, int> events;
  RunHooks hooks;
  hooks.log = [&](const EventInsert& event) {
    ++events[event.kind];
    (*page)->mailbox().put(event);
  };
  hooks.progress = [&](const Snapshot& now) { (*page)->mailbox().put(now); };
  hooks.begun = [&](CampaignId campaign, Duration t) { (*page)->begun(campaign, t); };
  std::size_t accepted = 0;
  const auto outcome =
      run_requested(request, hooks, [&](const Store& store, CampaignId campaign, auto&&) {
        const auto boards = store.boards(campaign);
        REQUIRE(boards);
        for (const auto& [id, board] : *boards) {
          accepted += store.accepted_dwells(campaign, id)->size();
        }
      });
  over = true;
  for (auto& one : crowd) one.join();
  if (!outcome) FAIL(to_text(outcome.error()));
  CHECK(std::holds_alternative<campaign::Finished>(outcome->state));
  CHECK(accepted == 6);
  CHECK(events["board_lost"] == 0);
  CHECK(events["chamber_lost"] == 0);
  CHECK(answers > 0);
}

}  // namespace gyrocal::status
