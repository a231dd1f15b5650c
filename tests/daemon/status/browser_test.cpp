// The page as a person sees it, in a headless Chromium. What it shows is tested without one too
// (answers_test, daemon_page_test); here it is that it shows it, live.
#include "tests/daemon/status/browser.h"

#include "daemon/status/http_server.h"
#include "tests/daemon/runner/temporary_folder.h"
#include "tests/daemon/status/http_client.h"
#include "tests/daemon/status/sample_view.h"

namespace gyrocal::status {
namespace {

/// Views of a campaign that goes on.
class Campaign {
 public:
  View next() {
    auto now = sample_snapshot();
    now.t += seconds(5.0 * ++turns_);
    now.text = "turn " + std::to_string(turns_);
    live_.report(now, turns_);
    return live_.at(sample_utc_ns, turns_);
  }

 private:
  LiveStatus live_{sample_facts()};
  int turns_ = 0;
};

std::unique_ptr<HttpServer> served(const Feed& feed, int port) {
  auto server = HttpServer::start(feed, "127.0.0.1", port);
  if (!server) FAIL(to_text(server.error()));
  return std::move(*server);
}

}  // namespace

SCENARIO("the page loads, updates, survives a restart of the daemon, and fits a phone") {
  const auto program = chromium();
  if (!program) {
    WARN("SKIPPED: no chromium in PATH (Debian: chromium)");
    return;
  }
  const runner::TemporaryFolder folder;
  const int port = free_port();
  Campaign campaign;
  auto feed = std::make_unique<Feed>(campaign.next());
  auto server = served(*feed, port);
  Browser browser(*program, folder / "profile");
  browser.open("http://127.0.0.1:" + std::to_string(port) + "/");
  const std::string where = "document.querySelector('.where')?.textContent";
  const std::string link = "document.getElementById('link')?.textContent";
  CHECK(browser.becomes(where + " === 'turn 1'"));
  CHECK(browser.becomes(link + " === 'live'"));

  feed->publish(campaign.next());
  feed->publish(campaign.next());
  CHECK(browser.becomes(where + " === 'turn 3'"));
  CHECK(browser.becomes("document.querySelectorAll('#plots canvas').length > 0"));

  feed->close();
  server.reset();
  CHECK(browser.becomes(link + " === 'daemon away'"));
  CHECK(browser.value(where) == "turn 3");
  feed = std::make_unique<Feed>(campaign.next());
  server = served(*feed, port);
  CHECK(browser.becomes(link + " === 'live'"));
  CHECK(browser.becomes(where + " === 'turn 4'"));

  browser.phone();
  CHECK(browser.becomes("innerWidth === 390"));
  CHECK(browser.value("document.documentElement.scrollWidth") == 390);
  CHECK(browser.value("[...document.querySelectorAll('#boards td')].every("
                      "cell => cell.getBoundingClientRect().right <= 390)") == true);
  CHECK(browser.exceptions() == "");
  feed->close();
  server.reset();
}

}  // namespace gyrocal::status
