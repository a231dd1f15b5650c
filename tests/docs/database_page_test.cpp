#include <catch2/catch.hpp>

#include "config/text_file.h"
#include "tests/daemon/cli/run_gyrocal.h"

using namespace gyrocal;

TEST_CASE("docs/database.md is what gyrocal db schema prints", "[docs]") {
  const auto printed = run_gyrocal("db schema");
  REQUIRE(printed.exit_code == 0);
  INFO("after a change of schema: gyrocal db schema > docs/database.md");
  CHECK(read_text_file(GYROCAL_SOURCE_DIR "/docs/database.md").value() == printed.out);
}
