// The exported header through a C compiler, run, and held to the model.
#include "compensation/firmware/c_header.h"

#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "compensation/drift/analysis.h"
#include "compensation/drift/paper.h"
#include "compensation/firmware/export.h"

using namespace gyrocal;
namespace fs = std::filesystem;

namespace {

struct Directory {
  fs::path path = fs::temp_directory_path() / ("gyrocal_firmware_test." + std::to_string(getpid()));
  Directory() { fs::create_directories(path); }
  ~Directory() {
    std::error_code ignored;
    fs::remove_all(path, ignored);
  }
};

int run(const std::string& command) {
  const int status = std::system(command.c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

FirmwareRequest request_of_all_axes(FirmwareFormat format) {
  const auto analysis = analyse(paper_table_1());
  REQUIRE(analysis.has_value());
  FirmwareRequest request;
  request.format = format;
  request.software_version = "test";
  const char* names[] = {"x", "y", "z"};
  for (std::size_t i = 0; i < 3; ++i) {  // gm11, improved_gm11, least_squares
    request.axes.push_back({{"0123456789ABCDEF01234567", names[i], "board"}, analysis->models[i]});
  }
  return request;
}

constexpr const char* program = R"(
#include <stdio.h>
#include "gyro_zero_drift.h"
int main(void)
{
    int i;
    printf("%d %d %d\n", gyrocal_is_for("0123456789ABCDEF01234567"), gyrocal_is_for("0123"),
           gyrocal_is_for("0123456789ABCDEF012345678"));
    for (i = -1200; i <= 5200; ++i) {
        float x, y, z;
        const float t = (float)i / 100.0f;
        const int out_x = gyrocal_zero_drift_x(t, &x);
        const int out_y = gyrocal_zero_drift_y(t, &y);
        const int out_z = gyrocal_zero_drift_z(t, &z);
        printf("%.9g %d %.9g %d %.9g %d %.9g\n", t, out_x, x, out_y, y, out_z, z);
    }
    return 0;
}
)";

}  // namespace

TEST_CASE("the C header compiles without a warning, runs, and follows its models",
          "[firmware][compile]") {
  const Directory directory;
  const auto request = request_of_all_axes(FirmwareFormat::c);
  const auto file = export_firmware(request);
  REQUIRE(file.has_value());
  std::ofstream(directory.path / "gyro_zero_drift.h") << file->text;
  std::ofstream(directory.path / "main.c") << program;
  const std::string compile = "cd " + directory.path.string() +
                              " && " GYROCAL_C_COMPILER
                              " -std=c99 -Wall -Wextra -Wpedantic -Wconversion -Wshadow -Werror "
                              "main.c -o main";
  REQUIRE(run(compile) == 0);
  REQUIRE(run(directory.path.string() + "/main > " + directory.path.string() + "/out") == 0);

  std::ifstream out(directory.path / "out");
  int mine = 0, shorter = 1, longer = 1;
  out >> mine >> shorter >> longer;
  CHECK(mine == 1);
  CHECK(shorter == 0);
  CHECK(longer == 0);
  int rows = 0;
  double largest = 0;
  double t = 0;
  while (out >> t) {
    const bool outside = t < -10 || t > 50;
    for (const auto& axis : request.axes) {
      int said_outside = 0;
      double drift = 0;
      out >> said_outside >> drift;
      CHECK(said_outside == (outside ? 1 : 0));
      const auto model = evaluate(axis.model, {std::clamp(t, -10.0, 50.0)});
      REQUIRE(model.has_value());
      largest = std::max(largest, std::abs(drift - *model));
    }
    ++rows;
  }
  CHECK(rows == 6401);
  CHECK(largest < 1.1e-4);
}

TEST_CASE("the C header is a C++ header too", "[firmware][compile]") {
  const Directory directory;
  const auto file = export_firmware(request_of_all_axes(FirmwareFormat::c));
  REQUIRE(file.has_value());
  std::ofstream(directory.path / "gyro_zero_drift.h") << file->text;
  std::ofstream(directory.path / "main.cpp")
      << "#include \"gyro_zero_drift.h\"\n#include \"gyro_zero_drift.h\"\n"
         "int main() { float d = 0; return gyrocal_zero_drift_z(20.0f, &d); }\n";
  CHECK(run("cd " + directory.path.string() +
            " && " GYROCAL_CXX_COMPILER
            " -std=c++11 -Wall -Wextra -Werror main.cpp -o main && ./main") == 0);
}

TEST_CASE("a header that was cut off or edited is not read back", "[firmware][bad input]") {
  const AxisTable axis{{"A", "z", "board"}, {{0, 10}, {4, 5}}};
  const auto text = c_header_text({&axis, 1}, "a comment");
  REQUIRE(read_c_header(text).value() == std::vector<AxisTable>{axis});
  CHECK_FALSE(read_c_header("").has_value());
  CHECK_FALSE(read_c_header(text.substr(0, text.find("gyrocal_drift_dps_z"))).has_value());
  auto edited = text;
  edited.replace(edited.find("5.00000000e+00f"), 15, "about five");
  CHECK_FALSE(read_c_header(edited).has_value());
}
