#include <fmt/core.h>

#include <memory>

#include "daemon/cli/command.h"
#include "daemon/cli/one_of.h"
#include "daemon/cli/outcome.h"
#include "daemon/cli/text_output.h"
#include "daemon/report/campaign_report.h"
#include "daemon/report/gnuplot.h"
#include "gyrocal_version.h"

namespace gyrocal::cli {
namespace {

struct ReportOptions {
  std::string database;
  std::string out;
  std::string format = "html";
  std::string figure;
};

std::vector<report::NamedFigure> all_figures(const report::CampaignFacts& facts) {
  std::vector<report::NamedFigure> figures{report::temperature_figure(facts)};
  for (const report::BoardFacts& board : facts.boards) {
    for (const report::AxisFacts& axis : board.axes) {
      for (auto& figure : report::axis_figures(facts, board, axis)) {
        figures.push_back(std::move(figure));
      }
    }
  }
  return figures;
}

Result<std::string> one_figure(const report::CampaignFacts& facts, const std::string& wanted) {
  std::vector<std::string> names;
  for (const report::NamedFigure& figure : all_figures(facts)) {
    if (figure.name == wanted) return report::svg_of(figure.figure);
    names.push_back(figure.name);
  }
  return fail(Errc::unknown_name, fmt::format("no figure is named \"{}\"", wanted),
              one_of(wanted, "--figure takes one of", names));
}

int write_report(const ReportOptions& options) {
  const auto facts = report::read_campaign_facts(options.database);
  if (!facts) return report(facts.error());
  const auto text = options.format == "svg" ? one_figure(*facts, options.figure)
                                            : report::campaign_report(*facts, GYROCAL_VERSION);
  if (!text) return report(text.error());
  const auto written = write_text_file(options.out, *text);
  return written ? exit_done : report(written.error());
}

}  // namespace

void add_report(Command& root, Chosen& chosen) {
  auto* command = root.add_subcommand(
      "report",
      "Example: gyrocal report --db weekend.db -o weekend.html\n"
      "Example: gyrocal report --db weekend.db --format svg --figure board0_z_drift -o drift.svg\n"
      "Writes the latest campaign as one self-contained HTML file, or one of its figures.");
  const auto options = std::make_shared<ReportOptions>();
  command->add_option("--db", options->database, "a campaign's database")->required();
  command->add_option("-o,--out", options->out, "the file to write")->required();
  auto* format = command->add_option("--format", options->format, "html or svg")
                     ->capture_default_str()
                     ->one_of({"html", "svg"});
  auto* figure = command->add_option("--figure", options->figure, "with svg: which figure");
  figure->needs(format);
  command->callback([options, &chosen] { chosen = [options] { return write_report(*options); }; });
}

}  // namespace gyrocal::cli
