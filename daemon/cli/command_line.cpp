#include "daemon/cli/command_line.h"

#include <CLI/CLI.hpp>
#include <utility>

namespace gyrocal::cli {

Option* Option::required(bool yes) {
  option_->required(yes);
  return this;
}

Option* Option::capture_default_str() {
  option_->capture_default_str();
  return this;
}

Option* Option::excludes(const Option* other) {
  option_->excludes(other->option_);
  return this;
}

Option* Option::needs(const Option* other) {
  option_->needs(other->option_);
  return this;
}

Option* Option::delimiter(char between) {
  option_->delimiter(between);
  return this;
}

Option* Option::one_of(std::vector<std::string> choices) {
  option_->check(CLI::IsMember(std::move(choices)));
  return this;
}

Option* Option::within(int low, int high) {
  option_->check(CLI::Range(low, high));
  return this;
}

Option* Option::within(double low, double high) {
  option_->check(CLI::Range(low, high));
  return this;
}

bool Option::given() const { return !option_->empty(); }
bool Option::is_positional() const { return option_->get_positional(); }
bool Option::is_required() const { return option_->get_required(); }
bool Option::takes_value() const { return option_->get_items_expected_max() > 0; }
std::vector<std::string> Option::long_names() const { return option_->get_lnames(); }
std::vector<std::string> Option::short_names() const { return option_->get_snames(); }
std::string Option::positional_name() const { return option_->get_name(true); }
std::string Option::type_name() const { return option_->get_type_name(); }
std::string Option::description() const { return option_->get_description(); }
bool Option::goes_by(const std::string& flag) const { return option_->check_name(flag); }

Command::Command(const std::string& description, const std::string& name)
    : program_(std::make_unique<CLI::App>(description, name)), app_(program_.get()) {
  keep(app_->get_help_ptr());
}

Command::Command(CLI::App& app, const Command& parent) : app_(&app), parent_(&parent) {
  keep(app_->get_help_ptr());
}

Command::~Command() = default;

Option* Command::keep(CLI::Option* option) {
  return options_.emplace_back(std::make_unique<Option>(*option)).get();
}

Command* Command::add_subcommand(const std::string& name, const std::string& description) {
  CLI::App* const app = app_->add_subcommand(name, description);
  return subcommands_.emplace_back(std::make_unique<Command>(*app, *this)).get();
}

void Command::require_subcommand(int at_least, int at_most) {
  app_->require_subcommand(static_cast<std::size_t>(at_least), static_cast<std::size_t>(at_most));
}

template <OptionValue T>
Option* Command::add_option(const std::string& names, T& to, const std::string& description) {
  return keep(app_->add_option(names, to, description));
}

#define GYROCAL_OPTION_OF(...)                                                        \
  template Option* Command::add_option<__VA_ARGS__>(const std::string&, __VA_ARGS__&, \
                                                    const std::string&)
GYROCAL_OPTION_OF(std::string);
GYROCAL_OPTION_OF(int);
GYROCAL_OPTION_OF(double);
GYROCAL_OPTION_OF(unsigned);
GYROCAL_OPTION_OF(std::int64_t);
GYROCAL_OPTION_OF(std::uint64_t);
GYROCAL_OPTION_OF(std::optional<int>);
GYROCAL_OPTION_OF(std::optional<unsigned>);
GYROCAL_OPTION_OF(std::optional<double>);
GYROCAL_OPTION_OF(std::optional<std::int64_t>);
GYROCAL_OPTION_OF(std::vector<std::string>);
GYROCAL_OPTION_OF(std::vector<int>);
GYROCAL_OPTION_OF(std::vector<double>);
#undef GYROCAL_OPTION_OF

Option* Command::add_flag(const std::string& names, bool& to, const std::string& description) {
  return keep(app_->add_flag(names, to, description));
}

Option* Command::add_flag(const std::string& names, std::optional<bool>& to,
                          const std::string& description) {
  return keep(app_->add_flag(names, to, description));
}

Option* Command::add_version_flag(const std::string& text) {
  return keep(app_->set_version_flag("--version", text, "print the version and exit"));
}

Option* Command::add_word(const std::string& names, std::vector<std::string> words,
                          const std::string& description,
                          std::function<void(const std::string&)> take) {
  return keep(app_->add_option_function<std::string>(names, std::move(take), description))
      ->one_of(std::move(words));
}

void Command::callback(std::function<void()> chosen) {
  app_->callback([chosen = std::move(chosen)] {
    try {
      chosen();
    } catch (const MissingOption& missing) {
      throw CLI::RequiredError(missing.what());
    }
  });
}

Parsed Command::parse(int argc, const char* const* argv) {
  try {
    app_->parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app_->exit(error) == 0 ? Parsed::helped : Parsed::refused;
  }
  return Parsed::accepted;
}

std::string Command::name() const { return app_->get_name(); }
std::string Command::description() const { return app_->get_description(); }
bool Command::subcommand_given() const { return !app_->get_subcommands().empty(); }

}  // namespace gyrocal::cli
