#include "tests/schema/temporary_folder.h"

#include <unistd.h>

#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <vector>

#include "schema/sqlite.h"

using namespace gyrocal;

TemporaryFolder::TemporaryFolder() {
  // In memory where there is such a folder: thousands of synced commits are no work for a disk.
  const bool shm = ::access("/dev/shm", W_OK) == 0;
  const auto root =
      shm ? std::filesystem::path("/dev/shm") : std::filesystem::temp_directory_path();
  path_ = (root / "gyrocal-test-XXXXXX").string();
  REQUIRE(::mkdtemp(path_.data()) != nullptr);
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

std::string dump(const std::string& path) {
  const auto database = Database::open(path, OpenMode::read_only);
  REQUIRE(database.has_value());
  auto tables = database->prepare(
      "SELECT name FROM sqlite_schema WHERE type = 'table' AND name NOT LIKE 'sqlite%' ORDER BY 1");
  REQUIRE(tables.has_value());
  std::string text;
  while (tables->next().value()) {
    const auto table = tables->text(0);
    auto rows = database->prepare("SELECT * FROM " + table);
    REQUIRE(rows.has_value());
    while (rows->next().value()) {
      text += table;
      for (int i = 0; i < rows->columns(); ++i) {
        text += '|';
        text += rows->is_null(i) ? std::string("NULL") : rows->text(i);
      }
      text += '\n';
    }
  }
  return text;
}

void write_file(const std::string& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}
