#include "compensation/firmware/table_text.h"

#include <fmt/format.h>

#include "compensation/firmware/text_scan.h"

namespace gyrocal {
namespace {

constexpr std::string_view csv_header = "board,axis,temperature_scale,temperature_c,zero_drift_dps";

std::string joined(const std::vector<float>& values) {
  std::string text;
  for (const float value : values) text += fmt::format("{}{:.9g}", text.empty() ? "" : ",", value);
  return text;
}

std::string quoted_lines(std::string_view comment) {
  std::string text;
  for (const auto line : lines_of(comment)) {
    text += fmt::format("{}\"", text.empty() ? "" : ",");
    for (const char c : line) {
      if (c == '"' || c == '\\') text += '\\';
      text += c;
    }
    text += '"';
  }
  return text;
}

}  // namespace

std::string csv_text(std::span<const AxisTable> axes) {
  std::string text = fmt::format("{}\n", csv_header);
  for (const auto& [identity, table] : axes) {
    for (std::size_t i = 0; i < table.temperature_c.size(); ++i) {
      text += fmt::format("{},{},{},{:.9g},{:.9g}\n", identity.board, identity.axis,
                          identity.temperature_scale, table.temperature_c[i], table.drift_dps[i]);
    }
  }
  return text;
}

Result<std::vector<AxisTable>> read_csv_text(std::string_view text) {
  std::vector<AxisTable> axes;
  bool first = true;
  for (const auto line : lines_of(text)) {
    if (line.empty()) continue;
    if (first) {
      if (line != csv_header) return fail(Errc::bad_input, "zero-drift CSV: another header");
      first = false;
      continue;
    }
    const auto fields = split(line, ',');
    const auto numbers =
        fields.size() == 5 && !fields[3].empty()
            ? float_list(line.substr(static_cast<std::size_t>(fields[3].data() - line.data())))
            : std::nullopt;
    if (!numbers)
      return fail(Errc::bad_input, fmt::format("zero-drift CSV: cannot read \"{}\"", line));
    const SensorIdentity identity{std::string(fields[0]), std::string(fields[1]),
                                  std::string(fields[2])};
    if (axes.empty() || axes.back().identity != identity) axes.push_back({identity, {}});
    axes.back().table.temperature_c.push_back((*numbers)[0]);
    axes.back().table.drift_dps.push_back((*numbers)[1]);
  }
  if (axes.empty()) return fail(Errc::bad_input, "zero-drift CSV: no rows");
  return axes;
}

std::string json_text(std::span<const AxisTable> axes, std::string_view comment) {
  std::string text = fmt::format(
      "{{\"format\":\"gyrocal-zero-drift/1\",\"board\":\"{}\",\"temperature_scale\":\"{}\","
      "\"comment\":[{}],\"axes\":[",
      axes.front().identity.board, axes.front().identity.temperature_scale, quoted_lines(comment));
  for (std::size_t i = 0; i < axes.size(); ++i) {
    text += fmt::format("{}\n{{\"axis\":\"{}\",\"temperature_c\":[{}],\"zero_drift_dps\":[{}]}}",
                        i == 0 ? "" : ",", axes[i].identity.axis,
                        joined(axes[i].table.temperature_c), joined(axes[i].table.drift_dps));
  }
  return text + "\n]}\n";
}

Result<std::vector<AxisTable>> read_json_text(std::string_view text) {
  const std::string board(text_between(text, "\"board\":\"", "\""));
  const std::string scale(text_between(text, "\"temperature_scale\":\"", "\""));
  std::vector<AxisTable> axes;
  for (const auto line : lines_of(text)) {
    if (!line.starts_with("{\"axis\":\"")) continue;
    auto temperature = float_list(text_between(line, "\"temperature_c\":[", "]"));
    auto drift = float_list(text_between(line, "\"zero_drift_dps\":[", "]"));
    if (!temperature || !drift || temperature->size() != drift->size()) {
      return fail(Errc::bad_input, "zero-drift JSON: a table cannot be read");
    }
    axes.push_back({{board, std::string(text_between(line, "{\"axis\":\"", "\"")), scale},
                    {std::move(*temperature), std::move(*drift)}});
  }
  if (axes.empty()) return fail(Errc::bad_input, "zero-drift JSON: no axis");
  return axes;
}

}  // namespace gyrocal
