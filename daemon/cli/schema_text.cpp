#include "daemon/cli/schema_text.h"

#include <fmt/core.h>

#include <algorithm>

namespace gyrocal::cli {
namespace {

std::string table_of(const std::string& reference) {
  return reference.substr(0, reference.find('('));
}

/// The tables that `table` refers to, itself left out, each once.
std::vector<std::string> parents(const TableInfo& table) {
  std::vector<std::string> found;
  for (const auto& column : table.columns) {
    const auto parent = table_of(column.references);
    if (parent.empty() || parent == table.name) continue;
    if (std::find(found.begin(), found.end(), parent) == found.end()) found.push_back(parent);
  }
  return found;
}

/// A table stands below the first table it refers to; the others are named beside it.
std::string branch(const Catalogue& catalogue, const std::string& below,
                   const std::string& indent) {
  std::vector<const TableInfo*> children;
  for (const auto& table : catalogue.tables) {
    const auto of = parents(table);
    if (!table.is_view && (of.empty() ? below.empty() : of.front() == below)) {
      children.push_back(&table);
    }
  }
  std::string text;
  for (const auto* child : children) {
    const bool last = child == children.back();
    const std::string stem = below.empty() ? "" : last ? "`- " : "|- ";
    const std::string next = below.empty() ? "" : last ? "   " : "|  ";
    auto line = fmt::format("{:<24}{}", indent + stem + child->name, child->comment);
    auto others = parents(*child);
    if (!others.empty()) others.erase(others.begin());
    for (const auto& other : others) line += " [also of " + other + "]";
    text += line + '\n' + branch(catalogue, child->name, indent + next);
  }
  return text;
}

/// A bar would end the Markdown cell.
std::string cell(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    if (c == '|') escaped += '\\';
    escaped += c;
  }
  return escaped;
}

std::string row_of(const ColumnInfo& column, bool is_view) {
  std::string comment = cell(column.comment.empty() ? "the row's number" : column.comment);
  if (!column.references.empty()) comment += fmt::format(" → `{}`", column.references);
  if (is_view) return fmt::format("| `{}` | {} |\n", column.name, comment);
  return fmt::format("| `{}`{} | {}{} | {} |\n", column.name, column.is_key ? " key" : "",
                     column.type, column.nullable ? ", NULL" : "", comment);
}

std::string section(const TableInfo& table) {
  auto text = fmt::format("\n### {}\n\n{}\n\n", table.name, table.comment);
  text += table.is_view ? "| column | meaning |\n|---|---|\n"
                        : "| column | type | meaning |\n|---|---|---|\n";
  for (const auto& column : table.columns) text += row_of(column, table.is_view);
  return text;
}

}  // namespace

std::string schema_markdown(const Catalogue& catalogue) {
  auto text = fmt::format(
      "# The database\n\n"
      "One campaign, or several, in one SQLite file: schema {}. This page is what `gyrocal db "
      "schema`\n"
      "prints, from the comments of the SQL itself; `.schema TABLE` in the `sqlite3` shell shows "
      "the\n"
      "same. Ready queries stand in [queries.md](queries.md).\n\n"
      "Read it with `sqlite3 -readonly`, Python's `sqlite3`, R's `RSQLite`, DuckDB's "
      "`sqlite_scan`,\n"
      "also while a campaign writes; or `gyrocal export --db F --table zero_drift > drift.csv`.\n\n"
      "- Units end the names: `_c` degrees Celsius, `_k` kelvin (a difference), `_dps` degrees "
      "per\n"
      "  second, `_lsb` counts of the board's converter, `_hz`, `_s`, `_ns`.\n"
      "- Times `t_ns` and `t_s` count from the campaign's start; `campaign.utc_start_ns` says "
      "when\n"
      "  that was.\n"
      "- NULL stands for \"not measured\".\n"
      "- Views keep their names and columns from schema to schema: new columns come at the end,\n"
      "  none goes or changes its meaning. Tables may change; `gyrocal db migrate` brings an "
      "older\n"
      "  file to the present schema and keeps a copy beside it.\n\n"
      "## What belongs to what\n\n```text\n",
      catalogue.version);
  text += branch(catalogue, "", "") + "```\n\n## Views\n";
  for (const auto& table : catalogue.tables) text += table.is_view ? section(table) : "";
  text += "\n## Tables\n";
  for (const auto& table : catalogue.tables) text += table.is_view ? "" : section(table);
  return text;
}

nlohmann::ordered_json schema_json(const Catalogue& catalogue) {
  auto tables = nlohmann::ordered_json::array();
  for (const auto& table : catalogue.tables) {
    auto columns = nlohmann::ordered_json::array();
    for (const auto& column : table.columns) {
      columns.push_back({{"name", column.name},
                         {"type", column.type},
                         {"nullable", column.nullable},
                         {"references", column.references},
                         {"comment", column.comment}});
    }
    tables.push_back({{"name", table.name},
                      {"kind", table.is_view ? "view" : "table"},
                      {"comment", table.comment},
                      {"columns", std::move(columns)}});
  }
  return {{"schema_version", catalogue.version}, {"tables", std::move(tables)}};
}

}  // namespace gyrocal::cli
