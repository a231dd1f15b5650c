#include "config/toml_section.h"

#include <fmt/core.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cmath>

#include "compensation/values/nearest_name.h"

namespace gyrocal {
namespace {

/// A value as a person wrote it, near enough to find it.
std::string shown(const toml::node& node) {
  if (const auto* s = node.as_string()) {
    return fmt::format("\"{}{}\"", s->get().substr(0, 60), s->get().size() > 60 ? "..." : "");
  }
  if (const auto* i = node.as_integer()) return fmt::format("{}", i->get());
  if (const auto* d = node.as_floating_point()) return fmt::format("{}", d->get());
  if (const auto* b = node.as_boolean()) return b->get() ? "true" : "false";
  if (node.is_table()) return "a table";
  if (node.is_array()) return fmt::format("an array of {}", node.as_array()->size());
  return "a date or time";
}

/// What stands under a key, for a message. A password written where none belongs, however its key
/// is spelled, must not reach a log.
std::string shown(std::string_view key, const toml::node& node) {
  const bool secret = key.find("pas") != std::string_view::npos && !key.ends_with("_file");
  return secret && node.is_string() ? "(not shown)" : shown(node);
}

std::string between(const char* kind, NumberRange range) {
  const std::string unit = range.unit.empty() ? "" : fmt::format(" [{}]", range.unit);
  return fmt::format("{} from {} to {}{}", kind, range.min, range.max, unit);
}

int line_of(const toml::node& node) { return static_cast<int>(node.source().begin.line); }

}  // namespace

struct TomlFile::Impl {
  struct Problem {
    Errc code;
    int line;
    std::string text;
  };
  toml::table table;
  std::string path;
  std::vector<Problem> problems;

  void note(Errc code, int line, const std::string& text) {
    problems.push_back({code, line, fmt::format("{}:{}: {}", path, std::max(line, 1), text)});
  }
};

struct TomlSection::Impl {
  TomlFile::Impl* file;
  const toml::table* table;  ///< null: the section is absent
  std::string name;          ///< dotted; empty at the root
  std::vector<std::string> asked;

  const toml::node* find(std::string_view key) {
    if (std::find(asked.begin(), asked.end(), key) == asked.end()) asked.emplace_back(key);
    return table == nullptr ? nullptr : table->get(key);
  }
  std::string dotted(std::string_view key) const {
    return name.empty() ? std::string(key) : fmt::format("{}.{}", name, key);
  }
  void note_value(std::string_view key, const toml::node& node, Errc code,
                  const std::string& expectation) {
    file->note(code, line_of(node),
               fmt::format("{} = {}: expected {}", dotted(key), shown(key, node), expectation));
  }
  /// A finite number in range, or a problem noted.
  std::optional<double> checked(std::string_view key, const toml::node& node, NumberRange range) {
    const auto value = node.is_number() ? node.value<double>() : std::nullopt;
    if (!value) {
      note_value(key, node, Errc::bad_input, between("a number", range));
      return std::nullopt;
    }
    if (!std::isfinite(*value)) {
      note_value(key, node, Errc::not_finite, between("a finite number", range));
      return std::nullopt;
    }
    if (*value < range.min || *value > range.max) {
      note_value(key, node, Errc::out_of_range, between("a number", range));
      return std::nullopt;
    }
    return value;
  }
};

TomlFile::TomlFile(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
TomlFile::TomlFile(TomlFile&&) noexcept = default;
TomlFile& TomlFile::operator=(TomlFile&&) noexcept = default;
TomlFile::~TomlFile() = default;

Result<TomlFile> TomlFile::parse(const std::string& text, const std::string& path) {
  try {
    auto impl = std::make_unique<Impl>();
    impl->table = toml::parse(text, path);
    impl->path = path;
    return TomlFile(std::move(impl));
  } catch (const toml::parse_error& error) {
    const auto at = error.source().begin;
    return fail(
        Errc::bad_input,
        fmt::format("{}:{}:{}: not TOML: {}", path, at.line, at.column, error.description()),
        "https://toml.io shows the format in one page");
  }
}

TomlSection TomlFile::root() {
  return TomlSection(
      std::make_shared<TomlSection::Impl>(TomlSection::Impl{impl_.get(), &impl_->table, "", {}}));
}

std::optional<Error> TomlFile::problems() const {
  if (impl_->problems.empty()) return std::nullopt;
  auto sorted = impl_->problems;
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const auto& a, const auto& b) { return a.line < b.line; });
  std::string what;
  for (const auto& problem : sorted) what += (what.empty() ? "" : "\n  ") + problem.text;
  return Error{sorted.front().code, what, ""};
}

TomlSection::TomlSection(std::shared_ptr<Impl> impl) : impl_(std::move(impl)) {}

bool TomlSection::has(std::string_view key) const { return impl_->find(key) != nullptr; }

bool TomlSection::flag(std::string_view key, bool fallback) {
  const auto* node = impl_->find(key);
  if (node == nullptr) return fallback;
  if (const auto* value = node->as_boolean()) return value->get();
  impl_->note_value(key, *node, Errc::bad_input, "true or false");
  return fallback;
}

double TomlSection::number(std::string_view key, double fallback, NumberRange range) {
  const auto* node = impl_->find(key);
  return node == nullptr ? fallback : impl_->checked(key, *node, range).value_or(fallback);
}

std::int64_t TomlSection::integer(std::string_view key, std::int64_t fallback, NumberRange range) {
  const auto* node = impl_->find(key);
  if (node == nullptr) return fallback;
  if (!node->is_integer()) {
    const bool not_finite =
        node->is_floating_point() && !std::isfinite(**node->as_floating_point());
    impl_->note_value(key, *node, not_finite ? Errc::not_finite : Errc::bad_input,
                      between("a whole number", range));
    return fallback;
  }
  const std::int64_t value = node->as_integer()->get();
  const auto as_double = static_cast<double>(value);
  if (as_double >= range.min && as_double <= range.max) return value;
  impl_->note_value(key, *node, Errc::out_of_range, between("a whole number", range));
  return fallback;
}

std::string TomlSection::text(std::string_view key, std::string_view fallback) {
  const auto* node = impl_->find(key);
  if (node == nullptr) return std::string(fallback);
  if (const auto* value = node->as_string()) return value->get();
  impl_->note_value(key, *node, Errc::bad_input, "a text in quotes");
  return std::string(fallback);
}

std::string TomlSection::required_text(std::string_view key, std::string_view what) {
  if (!has(key)) {
    expected(key, Errc::bad_input, std::string(what));
    return {};
  }
  const auto value = text(key, "?");
  if (value.empty()) expected(key, Errc::bad_input, std::string(what));
  return value;
}

std::size_t TomlSection::choice(std::string_view key, std::size_t fallback,
                                std::span<const std::string_view> names) {
  const auto* node = impl_->find(key);
  if (node == nullptr) return fallback;
  std::string list;
  for (const auto name : names) list += (list.empty() ? "" : ", ") + fmt::format("\"{}\"", name);
  if (const auto* value = node->as_string()) {
    const auto found = std::find(names.begin(), names.end(), value->get());
    if (found != names.end()) return static_cast<std::size_t>(found - names.begin());
    const auto near = nearest_name(value->get(), names);
    if (!near.empty()) list += fmt::format("; did you mean \"{}\"?", near);
    impl_->note_value(key, *node, Errc::unknown_name, "one of " + list);
  } else {
    impl_->note_value(key, *node, Errc::bad_input, "one of " + list);
  }
  return fallback;
}

std::vector<double> TomlSection::numbers(std::string_view key, std::vector<double> fallback,
                                         NumberRange range) {
  const auto* node = impl_->find(key);
  if (node == nullptr) return fallback;
  const auto* array = node->as_array();
  if (array == nullptr || array->empty()) {
    impl_->note_value(key, *node, Errc::bad_input, between("an array of numbers, each", range));
    return fallback;
  }
  std::vector<double> values;
  for (const auto& element : *array) {
    const auto place = fmt::format("{}[{}]", key, values.size());
    values.push_back(impl_->checked(place, element, range).value_or(range.min));
  }
  return values;
}

TomlSection TomlSection::section(std::string_view key) {
  const auto* node = impl_->find(key);
  const auto* table = node == nullptr ? nullptr : node->as_table();
  if (node != nullptr && table == nullptr) {
    impl_->note_value(key, *node, Errc::bad_input, fmt::format("a table [{}]", impl_->dotted(key)));
  }
  return TomlSection(std::make_shared<Impl>(Impl{impl_->file, table, impl_->dotted(key), {}}));
}

std::vector<TomlSection> TomlSection::sections(std::string_view key) {
  const auto* node = impl_->find(key);
  if (node == nullptr) return {};
  const auto* array = node->as_array();
  if (array == nullptr || !array->is_array_of_tables()) {
    impl_->note_value(key, *node, Errc::bad_input,
                      fmt::format("[[{}]] tables, one each", impl_->dotted(key)));
    return {};
  }
  std::vector<TomlSection> found;
  for (const auto& element : *array) {
    const auto name = fmt::format("{}[{}]", impl_->dotted(key), found.size());
    found.push_back(
        TomlSection(std::make_shared<Impl>(Impl{impl_->file, element.as_table(), name, {}})));
  }
  return found;
}

std::vector<std::string> TomlSection::keys() const {
  std::vector<std::string> names;
  if (impl_->table == nullptr) return names;
  for (const auto& [key, node] : *impl_->table) names.emplace_back(key.str());
  return names;
}

void TomlSection::expected(std::string_view key, Errc code, const std::string& expectation) {
  if (const auto* node = impl_->find(key)) {
    impl_->note_value(key, *node, code, expectation);
    return;
  }
  const int line = impl_->table == nullptr ? 1 : line_of(*impl_->table);
  impl_->file->note(code, line,
                    fmt::format("{} is missing: expected {}", impl_->dotted(key), expectation));
}

void TomlSection::refuse_unknown_keys() {
  if (impl_->table == nullptr) return;
  const std::vector<std::string_view> known(impl_->asked.begin(), impl_->asked.end());
  for (const auto& [key, node] : *impl_->table) {
    if (std::find(known.begin(), known.end(), key.str()) != known.end()) continue;
    const auto near = nearest_name(key.str(), known);
    std::string hint;
    for (const auto name : known) hint += (hint.empty() ? "" : ", ") + std::string(name);
    hint = near.empty() ? "known here: " + hint : fmt::format("did you mean \"{}\"?", near);
    impl_->file->note(Errc::unknown_name, static_cast<int>(key.source().begin.line),
                      fmt::format("unknown key {} = {}: {}", impl_->dotted(key.str()),
                                  shown(key.str(), node), hint));
  }
}

}  // namespace gyrocal
