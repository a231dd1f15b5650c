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

std::string page_name(const Command& command) {
  return fmt::format("{}", fmt::join(path_of(command), "-"));
}

std::string first_sentence(const Described& parts) {
  const auto end = parts.text.find_first_of(".;:");
  return parts.text.substr(0, end);
}

std::string synopsis(const Command& command) {
  auto line = fmt::format("{}", fmt::join(path_of(command), " "));
  for (const auto& option : command.options()) {
    if (option->is_positional()) {
      const auto name = option->positional_name();
      line += option->is_required() ? " " + name : " [" + name + "]";
    } else if (option->is_required()) {
      line += fmt::format(" {} {}", flags_of(*option).front(), option->type_name());
    }
  }
  if (!command.subcommands().empty()) line += " COMMAND";
  return line + " [OPTIONS]";
}

std::string option_entry(const Option& option) {
  const auto name = option.is_positional() ? option.positional_name()
                                           : fmt::format("{}", fmt::join(flags_of(option), ", "));
  const auto type = option.takes_value() ? fmt::format(" {}", option.type_name()) : "";
  return fmt::format(".TP\n.B {}{}\n{}\n", escaped(name), escaped(type),
                     escaped(option.description()));
}

std::string commands_section(const Command& command) {
  std::string text;
  for (const auto& each : command.subcommands()) {
    const auto parts = described(each->description());
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

std::string manual_page(const Command& command, const std::string& version) {
  const auto parts = described(command.description());
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
  for (const auto& option : command.options()) page += option_entry(*option);
  page += exit_status_section();
  if (command.parent() != nullptr) {
    page += fmt::format(".SH SEE ALSO\n.BR {} (1)\n", escaped(page_name(*command.parent())));
  }
  return page;
}

std::vector<std::pair<std::string, std::string>> manual_pages(const Command& command,
                                                              const std::string& version) {
  std::vector<std::pair<std::string, std::string>> pages{
      {page_name(command) + ".1", manual_page(command, version)}};
  for (const auto& each : command.subcommands()) {
    for (auto& page : manual_pages(*each, version)) pages.push_back(std::move(page));
  }
  return pages;
}

}  // namespace gyrocal::cli
