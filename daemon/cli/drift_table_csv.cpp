#include "daemon/cli/drift_table_csv.h"

#include <fmt/core.h>

#include <algorithm>

#include "daemon/cli/csv_columns.h"

namespace gyrocal::cli {
namespace {

Result<std::vector<double>> required(const CsvText& csv, const char* name) {
  const auto column = column_named(csv, name);
  if (!column) return tl::unexpected(column.error());
  return numbers_of(csv, *column);
}

Result<void> check_order(const CsvText& csv, const std::vector<double>& temperature_c) {
  const std::size_t column = *column_named(csv, "temperature_c");
  for (std::size_t i = 1; i < temperature_c.size(); ++i) {
    if (temperature_c[i] > temperature_c[i - 1]) continue;
    const auto earlier =
        std::find(temperature_c.begin(), temperature_c.begin() + static_cast<std::ptrdiff_t>(i),
                  temperature_c[i]);
    if (earlier != temperature_c.begin() + static_cast<std::ptrdiff_t>(i)) {
      return fail(Errc::bad_input,
                  fmt::format("{}: {} degC stands here again (first in line {})",
                              csv.place(i, column), temperature_c[i],
                              csv.line[static_cast<std::size_t>(earlier - temperature_c.begin())]),
                  "give each temperature once: average its rows or drop one");
    }
    return fail(Errc::bad_input,
                fmt::format("{}: {} degC follows {} degC", csv.place(i, column), temperature_c[i],
                            temperature_c[i - 1]),
                "expected strictly rising temperatures: sort the rows by temperature_c");
  }
  return {};
}

}  // namespace

Result<MeasuredTable> read_drift_table(const std::string& path) {
  const auto text = read_text(path);
  if (!text) return tl::unexpected(text.error());
  const auto csv = parse_csv(*text, path == "-" ? "standard input" : path);
  if (!csv) return tl::unexpected(csv.error());
  auto temperature = required(*csv, "temperature_c");
  if (!temperature) return tl::unexpected(std::move(temperature.error()));
  auto drift = required(*csv, "zero_drift_dps");
  if (!drift) return tl::unexpected(std::move(drift.error()));
  if (auto ordered = check_order(*csv, *temperature); !ordered) {
    return tl::unexpected(std::move(ordered.error()));
  }
  MeasuredTable measured{{std::move(*temperature), std::move(*drift)}, {}};
  if (const auto column = column_named(*csv, "standard_error_dps")) {
    auto errors = numbers_of(*csv, *column);
    if (!errors) return tl::unexpected(std::move(errors.error()));
    measured.standard_error_dps = std::move(*errors);
  }
  return measured;
}

}  // namespace gyrocal::cli
