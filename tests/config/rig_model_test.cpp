#include "config/rig_model.h"

#include <catch2/catch.hpp>
#include <string>

#include "config/json_line.h"
#include "config/rig_model_diff.h"

using namespace gyrocal;

namespace {

rig::RigModel with_effects() {
  rig::RigModel model;
  model.name = "found";
  model.parent = "default";
  model.parent_hash = rig_model_hash(rig::RigModel{});
  model.baseline.noise_dps = 0.1 + 1e-17;
  model.baseline.bias[0].dps[1] = 1.0 / 3.0;
  model.effects.push_back({"thermal_hysteresis",
                           "relay",
                           {{"h", 0.012}, {"t0", 17.0}, {"w", 3.0}},
                           {true, false, true},
                           {1, 2}});
  model.unexplained.push_back({rig::EmpiricalDriver::phase,
                               300.0,
                               {0.0, 0.5, 1.0},
                               {0.0, 0.01, 0.0},
                               {false, true, false}});
  return model;
}

/// A valid file with one line put into its list of effects, on line 3.
std::string file_with(const std::string& effect) {
  return "{\"format\": \"gyrocal-rig-model/1\", \"name\": \"m\",\n \"effects\": [\n  " + effect +
         "\n ]}";
}

Error refused(const std::string& text) {
  const auto model = parse_rig_model(text, "m.json");
  REQUIRE_FALSE(model);
  return model.error();
}

}  // namespace

TEST_CASE("a rig model reads back to the same bits") {
  const rig::RigModel model = with_effects();
  const auto again = parse_rig_model(rig_model_to_json(model), "m.json");
  REQUIRE(again);
  CHECK(*again == model);
}

TEST_CASE("the shipped default model is the baseline of the code") {
  const auto model = read_rig_model(default_rig_model);
  REQUIRE(model);
  CHECK(*model == rig::RigModel{});
}

TEST_CASE("each shipped model names its parent by the parent's hash") {
  for (const std::string name : {"quiet", "quiet_hysteresis"}) {
    const auto model = read_rig_model(name);
    REQUIRE(model);
    CHECK(model->name == name);
    const auto parent = read_rig_model(model->parent);
    REQUIRE(parent);
    CHECK(model->parent_hash == rig_model_hash(*parent));
  }
}

TEST_CASE("the hash follows what is simulated, not what it is called") {
  rig::RigModel model = with_effects();
  const std::string hash = rig_model_hash(model);
  CHECK(hash.size() == 16);
  model.name = "other";
  model.parent = "";
  CHECK(rig_model_hash(model) == hash);
  model.effects[0].parameters[0].second = 0.0120001;
  CHECK(rig_model_hash(model) != hash);
}

TEST_CASE("what an effect leaves out has the law's defaults, spelled out") {
  const auto model = parse_rig_model(file_with(R"({"effect": "thermal_hysteresis"})"), "m.json");
  REQUIRE(model);
  const rig::EffectUse& use = model->effects.at(0);
  CHECK(use.law == "play");
  CHECK(use.parameters == std::vector<std::pair<std::string, double>>{{"h", 0.02}, {"w", 2.5}});
  CHECK(use.axes == std::array<bool, 3>{true, true, true});
}

TEST_CASE("an unknown effect is refused with file, line and the known ones") {
  const Error error = refused(file_with(R"({"effect": "moon_phase"})"));
  CHECK(error.code == Errc::unknown_name);
  CHECK(error.what == "m.json:3: /effects/0/effect: unknown effect \"moon_phase\"");
  CHECK(error.advice.find("thermal_hysteresis, self_heating") != std::string::npos);
}

TEST_CASE("a parameter out of range is refused with file, line, place and range") {
  const Error error =
      refused(file_with("{\"effect\": \"thermal_hysteresis\",\n\"parameters\": {\"w\": -1}}"));
  CHECK(error.code == Errc::out_of_range);
  CHECK(error.what ==
        "m.json:4: /effects/0/parameters/w: effect thermal_hysteresis, law play, parameter w: -1 "
        "degC is out of range");
  CHECK(error.advice == "allowed: 0.1..40 degC");
}

TEST_CASE("other mistakes in a rig model name their place too") {
  CHECK(refused(file_with(R"({"effect": "bias_jump", "law": "leap"})")).what ==
        "m.json:3: /effects/0/law: effect bias_jump: unknown law \"leap\"");
  CHECK(refused(file_with(R"({"effect": "bias_jump", "parameters": {"a": "big"}})")).what ==
        "m.json:3: /effects/0/parameters/a: string, but a number expected");
  CHECK(refused(file_with(R"({"effect": "bias_jump", "axes": "xq"})")).what ==
        "m.json:3: /effects/0/axes: not a choice of axes");
  CHECK(refused(file_with(R"({"law": "step"})")).what ==
        "m.json:3: /effects/0: no \"effect\": which one?");
  CHECK(
      refused(R"({"format": "gyrocal-rig-model/1", "name": "m", "baseline": {"nose": 1}})").what ==
      "m.json:1: /baseline/nose: unknown key");
  CHECK(refused(R"({"format": "gyrocal-rig-model/1", "name": "m",
                    "baseline": {"noise_dps": -1}})")
            .what == "m.json:2: /baseline/noise_dps: -1 is out of range");
  CHECK(refused(R"({"format": "gyrocal-rig-model/9", "name": "m"})").what ==
        "m.json:1: /: format is \"gyrocal-rig-model/9\"");
  CHECK(refused("{\"format\": ").code == Errc::bad_input);
  CHECK(refused("[]").what == "m.json:1: /: array, but an object expected");
  CHECK(refused(R"({"format": "gyrocal-rig-model/1", "name": "m",
                    "unexplained": [{"driver": "die_c", "at": [1, 1], "dps": [0, 0]}]})")
            .what == "m.json:2: /unexplained/0: unexplained term: knots do not ascend");
}

TEST_CASE("a model that is not there is refused with what to do") {
  const auto model = read_rig_model("no_such_model");
  REQUIRE_FALSE(model);
  CHECK(model.error().code == Errc::bad_input);
  CHECK(model.error().advice.find("gyrocal rig models") != std::string::npos);
}

TEST_CASE("a JSON pointer leads to its line, through strings with brackets and escapes") {
  const std::string text =
      "{\n \"a\": \"x]}\\\"{\",\n \"b\": [1,\n  {\"c\":\n   true}],\n \"d\": {}\n}";
  CHECK(json_line(text, "") == 1);
  CHECK(json_line(text, "/a") == 2);
  CHECK(json_line(text, "/b/0") == 3);
  CHECK(json_line(text, "/b/1") == 4);
  CHECK(json_line(text, "/b/1/c") == 5);
  CHECK(json_line(text, "/d") == 6);
  CHECK(json_line(text, "/b/7") == 3);
}

TEST_CASE("two rig models are compared by what they simulate") {
  rig::RigModel from;
  rig::RigModel to;
  CHECK(rig_model_changes(from, to).empty());
  to.name = "other";
  to.baseline.noise_dps = 0.1;
  to.baseline.chamber.cycling_c = 0.0;
  from.effects = {{"bias_jump", "step", {{"a", 0.1}, {"t0", 60.0}}}, {"saturation", "", {}}};
  to.effects = {{"bias_jump", "step", {{"a", 0.2}, {"t0", 60.0}}},
                {"aging_drift", "", {{"c", 2.0}}, {false, false, true}, {}}};
  CHECK(rig_model_changes(from, to) ==
        std::vector<RigModelChange>{{"baseline.chamber.cycling_c", "0.15", "0"},
                                    {"baseline.noise_dps", "1.31", "0.1"},
                                    {"effect bias_jump: a", "0.1", "0.2"},
                                    {"effect saturation", "upper: hi = 6 dps", ""},
                                    {"effect aging_drift", "", "linear: c = 2 mdps/h on z"}});
  to = from;
  to.effects[0] = {"bias_jump", "slide", {}};
  REQUIRE(rig_model_changes(from, to).size() == 1);
  CHECK(rig_model_changes(from, to)[0].after == "slide: a = 0.02 dps, t0 = 18000 s, d = 20 s");
}
