#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "compensation/values/error.h"

namespace gyrocal {

/// What a number in a file may be, both ends included.
struct NumberRange {
  double min;
  double max;
  std::string_view unit = {};  ///< for the message: "s", "degC"
};

class TomlSection;

/// A TOML text with the problems found in it. Reading goes on after a problem, so that a person
/// sees all of them at once. Reading goes through
/// this wrapper of toml++ alone: nothing it throws leaves it.
class TomlFile {
 public:
  /// @return bad_input with file, line and column when the text is not TOML.
  [[nodiscard]] static Result<TomlFile> parse(const std::string& text, const std::string& path);

  TomlFile(TomlFile&&) noexcept;
  TomlFile& operator=(TomlFile&&) noexcept;
  ~TomlFile();

  /// Valid while this file lives, as are all sections below it.
  [[nodiscard]] TomlSection root();
  /// The problems noted so far as one error, a line each in the order of the file; absent if none.
  [[nodiscard]] std::optional<Error> problems() const;

  struct Impl;

 private:
  explicit TomlFile(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

/// One table of a TOML file. Each reader takes a key, notes a problem if what stands there is not
/// what is expected, and then returns the fallback. Keys never asked for are unknown: see
/// refuse_unknown_keys().
class TomlSection {
 public:
  [[nodiscard]] bool has(std::string_view key) const;
  [[nodiscard]] bool flag(std::string_view key, bool fallback);
  [[nodiscard]] double number(std::string_view key, double fallback, NumberRange range);
  /// A whole number; range ends are whole.
  [[nodiscard]] std::int64_t integer(std::string_view key, std::int64_t fallback,
                                     NumberRange range);
  [[nodiscard]] std::string text(std::string_view key, std::string_view fallback);
  /// Same, but a problem if the key is absent; `expected` says what belongs there.
  [[nodiscard]] std::string required_text(std::string_view key, std::string_view expected);
  /// One of `names`; @return its position.
  [[nodiscard]] std::size_t choice(std::string_view key, std::size_t fallback,
                                   std::span<const std::string_view> names);
  [[nodiscard]] std::vector<double> numbers(std::string_view key, std::vector<double> fallback,
                                            NumberRange range);
  /// The table under `key`; an empty one if it is absent.
  [[nodiscard]] TomlSection section(std::string_view key);
  /// The tables of an array of tables; none if it is absent.
  [[nodiscard]] std::vector<TomlSection> sections(std::string_view key);
  /// The keys that stand in this table.
  [[nodiscard]] std::vector<std::string> keys() const;

  /// Notes a problem with the value of `key` (or its absence): "FILE:LINE: plan.KEY = VALUE:
  /// expected EXPECTED".
  void expected(std::string_view key, Errc code, const std::string& expectation);
  /// Notes a problem for each key nobody asked for, with the nearest known one.
  void refuse_unknown_keys();

  struct Impl;
  explicit TomlSection(std::shared_ptr<Impl> impl);

 private:
  std::shared_ptr<Impl> impl_;
};

}  // namespace gyrocal
