#include "config/rig_faults.h"

#include <catch2/catch.hpp>

using namespace gyrocal;

namespace {

const std::vector<std::string> boards{"left", "right"};

Result<std::vector<RigFault>> parsed(const std::string& text) {
  return parse_rig_faults(text, "f.toml", boards);
}

}  // namespace

TEST_CASE("a list of faults holds what its file says", "[config]") {
  const auto faults = parsed(R"(
[[fault]]
at_s = 3600
for_s = 30
device = "chamber"
kind = "late"
value = 2.5
[[fault]]
at_s = 10
for_s = 5
device = "right"
kind = "garbage"
[[fault]]
at_s = 20
device = "left"
kind = "reset"
[[fault]]
at_s = 7
device = "chamber"
kind = "panel_setpoint"
value = -5
)");
  if (!faults) FAIL(faults.error().what);
  CHECK(*faults == std::vector<RigFault>{{RigFaultKind::late, 3600, 30, {}, 2.5},
                                         {RigFaultKind::garbage, 10, 5, 1, 0.05},
                                         {RigFaultKind::reset, 20, 0, 0, 0},
                                         {RigFaultKind::panel_setpoint, 7, 0, {}, -5}});
}

TEST_CASE("no faults is a list too", "[config]") { CHECK(parsed("")->empty()); }

TEST_CASE("each mistake in a list of faults is named with its place", "[config][bad]") {
  struct Broken {
    std::string keys;
    std::string part;  // of the message
  };
  const auto broken = GENERATE(values<Broken>({
      {"at_s = 1\nfor_s = 1\ndevice = \"chamber\"\nkind = \"latte\"\n", "\"latte\""},
      {"at_s = 1\nfor_s = 1\ndevice = \"chamber\"\n", "kind is missing"},
      {"for_s = 1\ndevice = \"chamber\"\nkind = \"lost\"\n", "at_s is missing"},
      {"at_s = 1\ndevice = \"chamber\"\nkind = \"lost\"\n", "for_s is missing"},
      {"at_s = 1\nfor_s = 0\ndevice = \"chamber\"\nkind = \"lost\"\n", "for_s = 0"},
      {"at_s = 1\nfor_s = 1\nkind = \"lost\"\n", "device is missing"},
      {"at_s = 1\nfor_s = 1\ndevice = \"left\"\nkind = \"lost\"\n", "\"left\""},
      {"at_s = 1\nfor_s = 1\ndevice = \"middle\"\nkind = \"mute\"\n", "\"middle\""},
      {"at_s = 1\nfor_s = 1\ndevice = \"left\"\nkind = \"drop\"\nvalue = 1.5\n", "value = 1.5"},
      {"at_s = 1\nfor_s = 1\ndevice = \"left\"\nkind = \"mute\"\nvalue = 1\n", "value"},
      {"at_s = 1\nfor_s = 1\ndevice = \"left\"\nkind = \"reset\"\n", "for_s"},
      {"at_s = 1\ndevice = \"chamber\"\nkind = \"panel_setpoint\"\n", "value is missing"},
      {"at_s = nan\nfor_s = 1\ndevice = \"chamber\"\nkind = \"lost\"\n", "at_s = nan"},
  }));
  CAPTURE(broken.keys);
  const auto faults = parsed("[[fault]]\n" + broken.keys);
  REQUIRE_FALSE(faults.has_value());
  CAPTURE(faults.error().what);
  CHECK(faults.error().what.find("f.toml:") != std::string::npos);
  CHECK(faults.error().what.find(broken.part) != std::string::npos);
}
