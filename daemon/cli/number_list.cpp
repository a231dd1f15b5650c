#include "daemon/cli/number_list.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

namespace gyrocal::cli {
namespace {

constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
constexpr std::string_view blanks = " \t\r\n\v\f";

/// "standard input line 3, column 7". Found only when something is wrong, so counting lines costs
/// the good case nothing.
std::string place(std::string_view source, std::string_view before) {
  std::size_t line = 1;
  std::size_t line_begin = 0;
  for (std::size_t i = 0; i < before.size(); ++i) {
    const bool lone_return = before[i] == '\r' && (i + 1 == before.size() || before[i + 1] != '\n');
    if (before[i] != '\n' && !lone_return) continue;
    ++line;
    line_begin = i + 1;
  }
  return fmt::format("{} line {}, column {}", source, line, before.size() - line_begin + 1);
}

Error explained(std::string_view word, std::string where, std::errc code) {
  if (code == std::errc::result_out_of_range) {
    return {Errc::out_of_range, fmt::format("{}: '{}' is beyond a double", where, word),
            "expected a number of magnitude 1e-307 to 1e308"};
  }
  if (word.find(',') != std::string_view::npos) {
    return {Errc::bad_input, fmt::format("{}: '{}' holds a comma", where, word),
            "separate numbers by blanks or line ends and write the decimal point as '.'"};
  }
  return {Errc::bad_input, fmt::format("{}: '{}' is no number", where, word),
          "expected numbers such as 4.3839, separated by blanks or line ends"};
}

}  // namespace

Result<std::vector<double>> parse_numbers(std::string_view text, std::string_view source) {
  if (text.starts_with(byte_order_mark)) text.remove_prefix(byte_order_mark.size());
  std::vector<double> numbers;
  std::size_t at = text.find_first_not_of(blanks);
  while (at != std::string_view::npos) {
    const std::size_t end = std::min(text.find_first_of(blanks, at), text.size());
    const std::string_view word = text.substr(at, end - at);
    const bool plus = word.size() > 1 && word[0] == '+' && word[1] != '-';
    double value = 0;
    const auto [stopped, code] =
        std::from_chars(word.data() + (plus ? 1 : 0), word.data() + word.size(), value);
    if (code != std::errc{} || stopped != word.data() + word.size()) {
      return tl::unexpected(explained(word, place(source, text.substr(0, at)), code));
    }
    if (!std::isfinite(value)) {
      return fail(Errc::not_finite,
                  fmt::format("{}: '{}'", place(source, text.substr(0, at)), word),
                  "expected finite numbers; leave lost samples out");
    }
    numbers.push_back(value);
    at = text.find_first_not_of(blanks, end);
  }
  if (numbers.empty()) {
    return fail(Errc::too_few_points, fmt::format("{} line 1, column 1: no number", source),
                "expected numbers separated by blanks or line ends");
  }
  return numbers;
}

}  // namespace gyrocal::cli
