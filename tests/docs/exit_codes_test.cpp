#include <fmt/core.h>

#include <catch2/catch.hpp>

#include "config/text_file.h"
#include "daemon/cli/outcome.h"

using namespace gyrocal;

TEST_CASE("the page of exit codes is the program's own table", "[docs]") {
  const auto page = read_text_file(GYROCAL_SOURCE_DIR "/docs/exit_codes.md").value();
  std::string table("|---|---|\n");
  for (const auto& [code, meaning] : cli::exit_codes)
    table += fmt::format("| {} | {} |\n", code, meaning);
  INFO(table);
  CHECK(page.find(table + "\n") != std::string::npos);
}
