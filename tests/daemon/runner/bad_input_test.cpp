// What people get wrong, each with what was read, from where, what was expected and what to do. The
// devices are simulated ones on real endpoints; nothing is stored of a campaign that did not begin.
#include <fcntl.h>
#include <fmt/core.h>
#include <stdlib.h>
#include <unistd.h>

#include <catch2/catch.hpp>

#include "daemon/runner/preflight.h"
#include "daemon/runner/run_request.h"
#include "drivers/board/inemo_board.h"
#include "drivers/clocks.h"
#include "drivers/simulated/in_process_links.h"
#include "drivers/simulated/simulated_rig.h"
#include "tests/daemon/runner/served_rig.h"

namespace gyrocal::runner {
namespace {

Error refusal_of(const TemporaryFolder& folder, const std::string& text) {
  RunRequest request;
  request.campaign_path = folder.write("bad.toml", text);
  request.database = folder / "bad.db";
  RunHooks hooks;
  hooks.log = [](const EventInsert&) {};
  const auto outcome = run_requested(request, hooks, [](auto&&...) {});
  REQUIRE_FALSE(outcome);
  CHECK_FALSE(outcome.error().what.empty());
  CHECK_FALSE(outcome.error().advice.empty());
  const auto store = Store::open_read_only(folder / "bad.db");
  if (store) CHECK_FALSE(store->latest_campaign()->has_value());
  return outcome.error();
}

bool says(const Error& error, const std::string& part) {
  const bool found = to_text(error).find(part) != std::string::npos;
  if (!found) UNSCOPED_INFO(to_text(error));
  return found;
}

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  const auto at = text.find(what);
  REQUIRE(at != std::string::npos);
  return text.replace(at, what.size(), by);
}

/// A board whose link delivers replies and then no frame: what a firmware does that hangs.
class SilencedLink final : public ByteLink {
 public:
  explicit SilencedLink(ByteLink& target) : target_(target) {}
  Result<std::size_t> read(std::span<std::uint8_t> into) override {
    auto got = target_.read(into);
    if (got && started_) return std::min(*got, std::exchange(reply_left_, 0));
    return got;
  }
  Result<void> write(std::span<const std::uint8_t> bytes) override {
    started_ = bytes.size() == 3 && bytes[2] == 0x52;  // Start; its reply is 3 bytes long
    if (started_) reply_left_ = 3;
    return target_.write(bytes);
  }
  Result<void> reopen() override { return target_.reopen(); }

 private:
  ByteLink& target_;
  bool started_ = false;
  std::size_t reply_left_ = 0;
};

}  // namespace

SCENARIO("no chamber is there") {
  const TemporaryFolder folder;
  int port = 0;
  {
    const ServedRig rig(folder);
    port = rig.port();  // free again in a moment
  }
  const Error error = refusal_of(folder, campaign_text(folder, port));
  CHECK(says(error, fmt::format("127.0.0.1:{}", port)));
}

SCENARIO("the chamber is another than the profile says: it answers with exceptions") {
  const TemporaryFolder folder;
  const ServedRig rig(folder);
  const Error error = refusal_of(
      folder, replaced(campaign_text(folder, rig.port()), "\"yinhe\"", "\"watlow_f4t\""));
  CHECK(error.code == Errc::refused);
  CHECK(says(error, "exception"));
}

SCENARIO("the chamber has another unit: silence") {
  const TemporaryFolder folder;
  const ServedRig rig(folder);
  const Error error = refusal_of(
      folder, replaced(campaign_text(folder, rig.port()), "[[board]]", "unit = 9\n[[board]]"));
  CHECK(says(error, "127.0.0.1"));
}

SCENARIO("a board's device is not there") {
  const TemporaryFolder folder;
  const ServedRig rig(folder);
  const Error error =
      refusal_of(folder, replaced(campaign_text(folder, rig.port()), "/board1", "/board7"));
  CHECK(says(error, "board 'right'"));
  CHECK(says(error, "/board7"));
}

SCENARIO("a board's device is no iNEMO: it says nothing we know") {
  const TemporaryFolder folder;
  const ServedRig rig(folder);
  const int master = ::posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC);
  REQUIRE(::grantpt(master) == 0);
  REQUIRE(::unlockpt(master) == 0);
  REQUIRE(::symlink(::ptsname(master), (folder / "other").c_str()) == 0);
  const Error error =
      refusal_of(folder, replaced(campaign_text(folder, rig.port()), "/board1", "/other"));
  ::close(master);
  CHECK(says(error, "board 'right'"));
}

SCENARIO("another board than the campaign file names") {
  const TemporaryFolder folder;
  const ServedRig rig(folder);
  const std::string text = replaced(campaign_text(folder, rig.port()), "name = \"right\"",
                                    "name = \"right\"\nmcu_id = \"000000000000000000000000\"");
  const Error error = refusal_of(folder, text);
  CHECK(error.code == Errc::mismatch);
  CHECK(says(error, "the campaign file expects 000000000000000000000000"));
}

SCENARIO("a board accepts Start and never streams") {
  VirtualClock clock;
  SimulatedRig rig(rig::RigModel{}, 5, 1, yinhe(), 1);
  InProcessBoardLink wire(rig.board(0), clock);
  SilencedLink silenced(wire);
  InemoBoard board(silenced, clock);
  BoardConfig config;
  config.name = "left";
  config.device = "/dev/serial/by-id/left";
  const auto identity = inspect_board(config, board, {}, clock, seconds(5));
  REQUIRE_FALSE(identity);
  CHECK(identity.error().code == Errc::timeout);
  CHECK(says(identity.error(), "board 'left' at /dev/serial/by-id/left"));
  CHECK(says(identity.error(), "sent no frame in 5 s"));
}

SCENARIO("a second run on the same database, while the first writes") {
  const TemporaryFolder folder;
  const ServedRig rig(folder);
  const auto first = Store::open(folder / "bad.db");
  REQUIRE(first);
  const Error error = refusal_of(folder, campaign_text(folder, rig.port()));
  CHECK(error.code == Errc::busy);
  CHECK(says(error, std::to_string(::getpid())));
}

SCENARIO("a file that is no database, and one nobody can make") {
  const TemporaryFolder folder;
  const auto file = folder.write(
      "bad.db", "these are my notes, not a database, and they are long enough to see\n");
  const Error error = refusal_of(folder, campaign_text(folder, 15999));
  CHECK(says(error, "bad.db"));
  std::ifstream notes(file);
  std::string line;
  std::getline(notes, line);
  CHECK(line.starts_with("these are my notes"));
}

SCENARIO("virtual time is for simulated devices only; an unknown filter is found before the run") {
  const TemporaryFolder folder;
  std::string text =
      replaced(campaign_text(folder, 15999), "simulated = true", "simulated = false");
  text = replaced(text, "time_scale = 300", "time_scale = 1");
  RunRequest request;
  request.campaign_path = folder.write("real.toml", text);
  request.virtual_rig = VirtualRig{1, {}};
  const auto real = run_requested(request, {}, [](auto&&...) {});
  REQUIRE_FALSE(real);
  CHECK(real.error().code == Errc::bad_input);

  request.campaign_path = folder.write(
      "filter.toml", campaign_text(folder, 15999) + "[analysis]\nwavelet = \"db99\"\n");
  request.database = folder / "f.db";
  const auto filter = run_requested(request, {}, [](auto&&...) {});
  REQUIRE_FALSE(filter);
  CHECK(filter.error().code == Errc::unknown_name);
}

}  // namespace gyrocal::runner
