#include "daemon/cli/number_list.h"

#include <catch2/catch.hpp>

using namespace gyrocal;
using gyrocal::cli::parse_numbers;

namespace {

std::string complaint(std::string_view text) {
  const auto numbers = parse_numbers(text, "standard input");
  return numbers ? "none" : numbers.error().what;
}

}  // namespace

TEST_CASE("numbers may stand one a line, many a line, in DOS files and behind a byte-order mark",
          "[cli]") {
  const std::vector<double> expected{1, -2.5, 3000};
  CHECK(parse_numbers("1\n-2.5\n3e3\n", "f").value() == expected);
  CHECK(parse_numbers("1 -2.5\t3000", "f").value() == expected);
  CHECK(parse_numbers("\xEF\xBB\xBF+1\r\n-2.5\r\n\r\n3000\r\n", "f").value() == expected);
}

TEST_CASE("what is no finite number is named with its line and column", "[cli]") {
  CHECK(complaint("") == "standard input line 1, column 1: no number");
  CHECK(complaint(" \n") == "standard input line 1, column 1: no number");
  CHECK(complaint("1 2\n3 x4") == "standard input line 2, column 3: 'x4' is no number");
  CHECK(complaint("1\r\n2\r\n 3v") == "standard input line 3, column 2: '3v' is no number");
  CHECK(complaint("1\r2\r--3") == "standard input line 3, column 1: '--3' is no number");
  CHECK(complaint("\xEF\xBB\xBFx") == "standard input line 1, column 1: 'x' is no number");
  CHECK(complaint("1 2,") == "standard input line 1, column 3: '2,' holds a comma");
  CHECK(complaint("1\nnan") == "standard input line 2, column 1: 'nan'");
  CHECK(complaint("1\n-inf") == "standard input line 2, column 1: '-inf'");
  CHECK(complaint("1e999") == "standard input line 1, column 1: '1e999' is beyond a double");
  CHECK(parse_numbers("nan", "f").error().code == Errc::not_finite);
  CHECK(parse_numbers("x", "f").error().code == Errc::bad_input);
}
