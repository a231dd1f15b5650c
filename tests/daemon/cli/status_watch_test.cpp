#include "daemon/cli/status_watch.h"

#include <catch2/catch.hpp>

namespace gyrocal::cli {
namespace {

const std::string soaking =
    R"json({"state":"soaking","text":"soaking at 20.0 degC (point 2 of 3)","setpoints":3,)json"
    R"json("setpoints_done":1,"boards":2,"boards_present":1,"chamber_c":20.04,"setpoint_c":20,)json"
    R"json("left_s":3600,"since_s":65})json";

}  // namespace

SCENARIO("a status is one line, the most important first") {
  CHECK(status_line(soaking, std::nullopt, false).value() ==
        "soaking  1/3  20.0->20.0 degC  1:00:00 left  1 of 2 boards  since 0:01:05");
}

SCENARIO("what does not fit the terminal is left out, word by word") {
  CHECK(status_line(soaking, 40, false).value() == "soaking  1/3  20.0->20.0 degC");
  CHECK(status_line(soaking, 12, false).value() == "soaking");
  CHECK(status_line(soaking, 5, false).value() == "soak");
  for (std::size_t columns = 1; columns < 90; ++columns) {
    CHECK(status_line(soaking, columns, false).value().size() < columns);
  }
}

SCENARIO("colours take no room") {
  CHECK(status_line(soaking, 14, true).value() == "\033[32msoaking\033[0m  1/3");
}

SCENARIO("an answer that is none is an error") {
  CHECK(status_line("hello", 80, false).error().code == Errc::bad_input);
  CHECK_FALSE(answer_has_ended("hello"));
  CHECK_FALSE(answer_has_ended(soaking));
  CHECK(answer_has_ended(R"({"state":"safe","setpoints":3})"));
}

}  // namespace gyrocal::cli
