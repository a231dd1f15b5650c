#pragma once

#include <concepts>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace gyrocal::cli {

// The command line as CLI11 parses it. CLI11 is a header that costs seconds in each file that
// includes it, so command_line.cpp alone does; the names below are CLI11's where it has them.

/// What an option's value can be stored in.
template <class T>
concept OptionValue = std::same_as<T, std::string> || std::same_as<T, int> ||
    std::same_as<T, double> || std::same_as<T, unsigned> || std::same_as<T, std::int64_t> ||
    std::same_as<T, std::uint64_t> || std::same_as<T, std::optional<int>> ||
    std::same_as<T, std::optional<unsigned>> || std::same_as<T, std::optional<double>> ||
    std::same_as<T, std::optional<std::int64_t>> || std::same_as<T, std::vector<std::string>> ||
    std::same_as<T, std::vector<int>> || std::same_as<T, std::vector<double>>;

/// One option, flag or positional word of a command, which owns it.
class Option {
 public:
  explicit Option(CLI::Option& option) : option_(&option) {}

  Option* required(bool yes = true);
  Option* capture_default_str();  ///< show the present value as the default
  Option* excludes(const Option* other);
  Option* needs(const Option* other);
  Option* delimiter(char between);  ///< several values in one word
  Option* one_of(std::vector<std::string> choices);
  Option* within(int low, int high);
  Option* within(double low, double high);

  [[nodiscard]] bool given() const;
  [[nodiscard]] bool is_positional() const;
  [[nodiscard]] bool is_required() const;
  [[nodiscard]] bool takes_value() const;
  [[nodiscard]] std::vector<std::string> long_names() const;   ///< without the dashes
  [[nodiscard]] std::vector<std::string> short_names() const;  ///< without the dash
  [[nodiscard]] std::string positional_name() const;
  [[nodiscard]] std::string type_name() const;  ///< "TEXT:{x,y,z}"
  [[nodiscard]] std::string description() const;
  [[nodiscard]] bool goes_by(const std::string& flag) const;  ///< "--db"

 private:
  CLI::Option* option_;
};

/// Thrown by a callback: what the user did not give, as "--db or --session".
struct MissingOption : std::runtime_error {
  using std::runtime_error::runtime_error;
};

enum class Parsed {
  accepted,
  helped,   ///< help was asked for and printed
  refused,  ///< what was wrong has been printed to stderr
};

/// A program or one of its subcommands. What it hands out lives as long as the program's.
class Command {
 public:
  Command(const std::string& description, const std::string& name);
  Command(CLI::App& app, const Command& parent);
  Command(const Command&) = delete;
  Command& operator=(const Command&) = delete;
  ~Command();

  Command* add_subcommand(const std::string& name, const std::string& description);
  void require_subcommand(int at_least, int at_most);

  template <OptionValue T>
  Option* add_option(const std::string& names, T& to, const std::string& description);
  Option* add_flag(const std::string& names, bool& to, const std::string& description);
  Option* add_flag(const std::string& names, std::optional<bool>& to,
                   const std::string& description);
  /// `--version` prints this and ends the program.
  Option* add_version_flag(const std::string& text);
  /// An option whose words stand for values.
  template <class T>
  Option* add_named(const std::string& names, T& to, const std::map<std::string, T>& values,
                    const std::string& description) {
    std::vector<std::string> words;
    for (const auto& [word, value] : values) words.push_back(word);
    return add_word(names, words, description,
                    [&to, values](const std::string& word) { to = values.at(word); });
  }

  /// Called once everything has been parsed, where this command was chosen.
  /// @throws MissingOption from within: the command line is refused.
  void callback(std::function<void()> chosen);

  [[nodiscard]] Parsed parse(int argc, const char* const* argv);

  [[nodiscard]] std::string name() const;
  [[nodiscard]] std::string description() const;
  [[nodiscard]] const Command* parent() const { return parent_; }
  [[nodiscard]] bool subcommand_given() const;
  [[nodiscard]] const std::vector<std::unique_ptr<Command>>& subcommands() const {
    return subcommands_;
  }
  [[nodiscard]] const std::vector<std::unique_ptr<Option>>& options() const { return options_; }

 private:
  Option* keep(CLI::Option* option);
  Option* add_word(const std::string& names, std::vector<std::string> words,
                   const std::string& description, std::function<void(const std::string&)> take);

  std::unique_ptr<CLI::App> program_;  ///< empty: a subcommand, owned by its program's
  CLI::App* app_;
  const Command* parent_ = nullptr;
  std::vector<std::unique_ptr<Command>> subcommands_;
  std::vector<std::unique_ptr<Option>> options_;
};

}  // namespace gyrocal::cli
