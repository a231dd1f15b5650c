#include "compensation/values/nearest_name.h"

#include <array>
#include <catch2/catch.hpp>

using namespace gyrocal;

namespace {

constexpr std::array<std::string_view, 4> commands = {"fit", "diagnose", "denoise", "status"};

}  // namespace

TEST_CASE("one slip of each kind still finds the name", "[names]") {
  CHECK(nearest_name("diagnos", commands) == "diagnose");
  CHECK(nearest_name("diagnosse", commands) == "diagnose");
  CHECK(nearest_name("diagmose", commands) == "diagnose");
  CHECK(nearest_name("daignose", commands) == "diagnose");
  CHECK(nearest_name("fti", commands) == "fit");
  CHECK(nearest_name("fit", commands) == "fit");
}

TEST_CASE("a swap of neighbours counts once, so that it wins over two replaced letters",
          "[names]") {
  constexpr std::array<std::string_view, 2> near = {"abdd", "abdc"};
  CHECK(nearest_name("abcd", near) == "abdd");  // one edit each: the first of them
  constexpr std::array<std::string_view, 2> far = {"axxde", "acbde"};
  CHECK(nearest_name("abcde", far) == "acbde");
}

TEST_CASE("another word finds nothing", "[names]") {
  CHECK(nearest_name("export", commands).empty());
  CHECK(nearest_name("", commands).empty());
  CHECK(nearest_name("x", commands).empty());
  CHECK(nearest_name("fit", {}).empty());
  CHECK(nearest_name("f", commands).empty());
  CHECK(nearest_name(std::string(100000, 'd'), commands).empty());
}

TEST_CASE("advice names what is known and what is meant", "[names]") {
  CHECK(is_meant("staus", commands) == "is \"status\" meant? ");
  CHECK(is_meant("export", commands).empty());
  CHECK(known_names("commands", "staus", commands) ==
        "known commands: fit diagnose denoise status; is status meant?");
  CHECK(known_names("commands", "export", commands) ==
        "known commands: fit diagnose denoise status");
}
