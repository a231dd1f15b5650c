#include "daemon/report/page.h"

#include <fmt/core.h>

#include <algorithm>
#include <cstdlib>

namespace gyrocal::report {
namespace {

constexpr std::string_view style = R"(
:root { color-scheme: light dark; --ink: #1b1b1b; --paper: #fdfdfc; --rule: #c9c9c4; --soft: #5c5c58; }
@media (prefers-color-scheme: dark) {
  :root { --ink: #e6e6e2; --paper: #191a1b; --rule: #45474a; --soft: #a3a5a8; }
}
body { font: 16px/1.5 system-ui, sans-serif; color: var(--ink); background: var(--paper);
  max-width: 60rem; margin: 2rem auto; padding: 0 1rem; }
h1 { font-size: 1.6rem; } h2 { font-size: 1.2rem; margin-top: 2.2rem; border-bottom: 1px solid var(--rule); }
.banner { border: 2px solid var(--rule); border-radius: .4rem; padding: .7rem 1rem; }
.banner strong { text-transform: uppercase; letter-spacing: .04em; margin-right: .6rem; }
.wide { overflow-x: auto; margin-bottom: .8rem; }
table { border-collapse: collapse; font-size: .9rem; font-variant-numeric: tabular-nums; }
th, td { padding: .25rem .7rem; border-bottom: 1px solid var(--rule); text-align: left; vertical-align: top; }
.number { text-align: right; white-space: nowrap; }
figure { margin: 1.4rem 0; } figure svg { width: 100%; height: auto; border-radius: .3rem; }
figcaption { font-size: .9rem; color: var(--soft); }
@media print { body { max-width: none; margin: 0; font-size: 11pt; color: #000; background: #fff; }
  figure, table, tr, .banner { break-inside: avoid; } h2 { break-after: avoid; }
  .wide { overflow: visible; } }
)";

bool is_number(const std::string& cell) {
  if (cell.empty() || cell == "-") return true;
  char* end = nullptr;
  std::strtod(cell.c_str(), &end);
  return *end == '\0';
}

}  // namespace

std::string escaped(std::string_view text) {
  std::string safe;
  for (const char c : text) {
    switch (c) {
      case '&':
        safe += "&amp;";
        break;
      case '<':
        safe += "&lt;";
        break;
      case '>':
        safe += "&gt;";
        break;
      case '"':
        safe += "&quot;";
        break;
      default:
        safe += c;
    }
  }
  return safe;
}

Page::Page(std::string_view title) : title_(title) {
  body_ = fmt::format("<h1>{}</h1>\n", escaped(title));
}

void Page::heading(std::string_view text) { body_ += fmt::format("<h2>{}</h2>\n", escaped(text)); }

void Page::paragraph(std::string_view text) { body_ += fmt::format("<p>{}</p>\n", escaped(text)); }

void Page::banner(std::string_view word, std::string_view sentence) {
  body_ += fmt::format("<p class=\"banner\"><strong>{}</strong>{}</p>\n", escaped(word),
                       escaped(sentence));
}

void Page::table(const std::vector<std::string>& header,
                 const std::vector<std::vector<std::string>>& rows) {
  std::vector<const char*> cell_class;
  for (std::size_t column = 0; column < header.size(); ++column) {
    const bool numbers =
        !rows.empty() && std::all_of(rows.begin(), rows.end(),
                                     [&](const auto& row) { return is_number(row[column]); });
    cell_class.push_back(numbers ? " class=\"number\"" : "");
  }
  body_ += "<div class=\"wide\"><table><thead><tr>";
  for (std::size_t column = 0; column < header.size(); ++column) {
    body_ += fmt::format("<th{}>{}</th>", cell_class[column], escaped(header[column]));
  }
  body_ += "</tr></thead><tbody>\n";
  for (const auto& row : rows) {
    body_ += "<tr>";
    for (std::size_t column = 0; column < header.size(); ++column) {
      body_ += fmt::format("<td{}>{}</td>", cell_class[column], escaped(row[column]));
    }
    body_ += "</tr>\n";
  }
  body_ += "</tbody></table></div>\n";
}

void Page::figure(std::string_view svg, std::string_view caption) {
  body_ += fmt::format("<figure>{}<figcaption>{}</figcaption></figure>\n", svg, escaped(caption));
}

void Page::list(const std::vector<std::string>& items) {
  if (items.empty()) return;
  body_ += "<ul>\n";
  for (const std::string& item : items) body_ += fmt::format("<li>{}</li>\n", escaped(item));
  body_ += "</ul>\n";
}

std::string Page::finish() const {
  return fmt::format(
      "<!doctype html>\n<html lang=\"en\">\n<head><meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<title>{}</title>\n<style>{}</style></head>\n<body>\n{}</body>\n</html>\n",
      escaped(title_), style, body_);
}

}  // namespace gyrocal::report
