#include "daemon/cli/manual_page.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include "daemon/cli/command_tree.h"
#include "daemon/cli/outcome.h"

namespace gyrocal::cli {
namespace {

/// Text as roff takes it literally: hyphens stay ASCII, no line begins a request.
std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '\\') {
      out += "\\e";
    } else if (c == '-') {
      out += "\\-";
    } else if ((c == '.' || c == '\'') && (out.empty() || out.back() == '\n')) {
      out += "\\&";
      out += c;
    } else {
      out += c;
    }
  }
  return out;
}

std::string page_name(const CLI::App& command) {
  return fmt::format("{}", fmt::join(path_of(command), "-"));
}

std::string first_sentence(const Described& parts) {
  const auto end = parts.text.find_first_of(".;:");
  return parts.text.substr(0, end);
}

std::string synopsis(const CLI::App& command) {
  auto line = fmt::format("{}", fmt::join(path_of(command), " "));
  for (const CLI::Option* option : options(command)) {
    if (option->get_positional()) {
      const auto name = option->get_name(true);
      line += option->get_required() ? " " + name : " [" + name + "]";
    } else if (option->get_required()) {
      line += fmt::format(" {} {}", flags_of(*option).front(), option->get_type_name());
    }
  }
  if (!subcommands(command).empty()) line += " COMMAND";
  return line + " [OPTIONS]";
}

std::string option_entry(const CLI::Option& option) {
  const auto name = option.get_positional() ? option.get_name(true)
                                            : fmt::format("{}", fmt::join(flags_of(option), ", "));
  const auto type = takes_value(option) ? " " + option.get_type_name() : "";
  return fmt::format(".TP\n.B {}{}\n{}\n", escaped(name), escaped(type),
                     escaped(option.get_description()));
}

std::string commands_section(const CLI::App& command) {
  std::string text;
  for (const CLI::App* each : subcommands(command)) {
    const auto parts = described(each->get_description());
    text += fmt::format(".TP\n.B {}(1)\n{}\n", escaped(page_name(*each)),
                        escaped(parts.text.empty() ? parts.examples.front() : parts.text));
  }
  return text.empty() ? "" : ".SH COMMANDS\n" + text;
}

std::string exit_status_section() {
  std::string text(".SH EXIT STATUS\n");
  for (const auto& [code, meaning] : exit_codes) {
    text += fmt::format(".TP\n.B {}\n{}\n", code, escaped(meaning));
  }
  return text;
}

}  // namespace

std::string manual_page(const CLI::App& command, const std::string& version) {
  const auto parts = described(command.get_description());
  std::string upper;
  for (const char c : page_name(command)) {
    upper += static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  }
  auto page =
      fmt::format(".TH {} 1 \"\" \"gyrocal {}\" \"gyrocal manual\"\n", escaped(upper), version);
  page += fmt::format(".SH NAME\n{} \\- {}\n", escaped(page_name(command)),
                      escaped(parts.text.empty() ? "gyrocal's version" : first_sentence(parts)));
  page += ".SH SYNOPSIS\n.B " + escaped(synopsis(command)) + "\n.SH EXAMPLES\n.nf\n";
  for (const auto& example : parts.examples) page += escaped(example) + "\n";
  page += ".fi\n.SH DESCRIPTION\n" + escaped(parts.text) + "\n" + commands_section(command);
  page += ".SH OPTIONS\n";
  for (const CLI::Option* option : options(command)) page += option_entry(*option);
  page += exit_status_section();
  if (command.get_parent() != nullptr) {
    page += fmt::format(".SH SEE ALSO\n.BR {} (1)\n", escaped(page_name(*command.get_parent())));
  }
  return page;
}

std::vector<std::pair<std::string, std::string>> manual_pages(const CLI::App& command,
                                                              const std::string& version) {
  std::vector<std::pair<std::string, std::string>> pages{
      {page_name(command) + ".1", manual_page(command, version)}};
  for (const CLI::App* each : subcommands(command)) {
    for (auto& page : manual_pages(*each, version)) pages.push_back(std::move(page));
  }
  return pages;
}

}  // namespace gyrocal::cli
