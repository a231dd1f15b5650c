#include <catch2/catch.hpp>

#include "schema/sqlite.h"
#include "tests/schema/rig_rows.h"
#include "tests/schema/small_campaign.h"
#include "tests/schema/temporary_folder.h"

using namespace gyrocal;

TEST_CASE("rig models are kept with their parents, the same one once", "[store]") {
  const TemporaryFolder folder;
  auto store = Store::open(folder / "a.db").value();
  const auto first = store.add_rig_model(rig_rows::model("default", "aa")).value();
  auto child = rig_rows::model("with hysteresis", "bb");
  child.parent = first;
  child.effects = {{"thermal_hysteresis", "play", R"({"width_k":2.0})"}};
  const auto second = store.add_rig_model(child).value();
  CHECK(store.add_rig_model(child).value() == second);

  const auto models = store.rig_models().value();
  REQUIRE(models.size() == 2);
  CHECK(models[0].first == first);
  CHECK_FALSE(models[0].second.parent.has_value());
  CHECK(models[1].second.parent == first);
  REQUIRE(models[1].second.effects.size() == 1);
  CHECK(models[1].second.effects[0].law == "play");

  auto orphan = rig_rows::model("orphan", "cc");
  orphan.parent = RigModelId{77};
  CHECK_FALSE(store.add_rig_model(orphan).has_value());
  CHECK(store.rig_models().value().size() == 2);
}

TEST_CASE("a diagnosis is stored whole, and gap_history tells its steps", "[store]") {
  const TemporaryFolder folder;
  auto store = Store::open(folder / "a.db").value();
  const auto ids = small_campaign::begin(store);
  const auto before = store.add_rig_model(rig_rows::model("default", "aa")).value();
  const auto after = store.add_rig_model(rig_rows::model("better", "bb")).value();
  auto diagnosis = rig_rows::diagnosis(before, after);
  diagnosis.board = ids.first;
  REQUIRE(store.add_diagnosis(diagnosis));
  diagnosis.model_before = after;
  diagnosis.verdict.assign("consistent");
  diagnosis.findings.clear();
  REQUIRE(store.add_diagnosis(diagnosis));

  const auto database = Database::open(folder / "a.db", OpenMode::read_only).value();
  auto steps = database
                   .prepare(
                       "SELECT rig_model_before, rig_model_after, effect_added, gap_before, "
                       "gap_after FROM gap_history")
                   .value();
  REQUIRE(steps.next().value());
  CHECK(steps.text(0) == "default");
  CHECK(steps.text(1) == "better");
  CHECK(steps.text(2) == "thermal_hysteresis");
  CHECK(steps.real(3) == 6.5);
  CHECK(steps.real(4) == 0.4);
  REQUIRE(steps.next().value());
  CHECK(steps.is_null(2));
  CHECK(steps.real(3) == 6.5);  // nothing was added: the diagnosis' own
  CHECK_FALSE(steps.next().value());

  diagnosis.verdict.assign("perhaps");
  CHECK_FALSE(store.add_diagnosis(diagnosis).has_value());
  CHECK(database.integer("SELECT count(*) FROM diagnosis").value() == 2);
}
