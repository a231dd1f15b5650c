#include "compensation/firmware/c_header.h"

#include <fmt/format.h>

#include "compensation/firmware/text_scan.h"

namespace gyrocal {
namespace {

constexpr std::string_view shared_functions = R"(
/* 1 when this file was made for the board of that name. */
static inline int gyrocal_is_for(const char *board)
{
    const char *mine = GYROCAL_BOARD;
    while (*mine != '\0' && *mine == *board) {
        ++mine;
        ++board;
    }
    return *mine == *board;
}

static inline float gyrocal_interpolated(const float *t, const float *d, int last, float at)
{
    int i = 0;
    if (!(at > t[0])) return d[0];
    if (at >= t[last]) return d[last];
    while (at >= t[i + 1]) ++i;
    return d[i] + (d[i + 1] - d[i]) * ((at - t[i]) / (t[i + 1] - t[i]));
}
)";

std::string c_list(const std::vector<float>& values) {
  std::string text;
  for (std::size_t i = 0; i < values.size(); ++i) {
    text += i % 4 == 0 ? "\n    " : " ";
    text += fmt::format("{:.8e}f{}", values[i], i + 1 < values.size() ? "," : "");
  }
  return text;
}

std::string axis_text(const AxisTable& axis) {
  const auto& name = axis.identity.axis;
  const auto& t = axis.table.temperature_c;
  std::string text;
  text += fmt::format("\nstatic const float gyrocal_temperature_c_{}[{}] = {{{}\n}};\n", name,
                      t.size(), c_list(t));
  text += fmt::format("static const float gyrocal_drift_dps_{}[{}] = {{{}\n}};\n", name,
                      axis.table.drift_dps.size(), c_list(axis.table.drift_dps));
  text += fmt::format(
      "\n/* Zero drift of axis {0} [deg/s]; subtract it from the measured rate. Returns 0 inside "
      "{1:g} to\n * {2:g} degC; 1 outside or for NaN, where the value at the nearer end is given. "
      "*/\n"
      "static inline int gyrocal_zero_drift_{0}(float temperature_c, float *drift_dps)\n{{\n"
      "    *drift_dps = gyrocal_interpolated(gyrocal_temperature_c_{0}, gyrocal_drift_dps_{0}, "
      "{3},\n                                      temperature_c);\n"
      "    return !(temperature_c >= gyrocal_temperature_c_{0}[0] &&\n"
      "             temperature_c <= gyrocal_temperature_c_{0}[{3}]);\n}}\n",
      name, t.front(), t.back(), t.size() - 1);
  return text;
}

std::string macro(std::string_view text, std::string_view name) {
  return std::string(text_between(text, fmt::format("#define {} \"", name), "\""));
}

}  // namespace

std::string c_header_text(std::span<const AxisTable> axes, std::string_view comment) {
  std::string text = "/*\n";
  for (const auto line : lines_of(comment)) text += fmt::format(" * {}\n", line);
  text += " */\n#ifndef GYROCAL_ZERO_DRIFT_H\n#define GYROCAL_ZERO_DRIFT_H\n\n";
  text += fmt::format("#define GYROCAL_BOARD \"{}\"\n", axes.front().identity.board);
  text += fmt::format("#define GYROCAL_TEMPERATURE_SCALE \"{}\"\n",
                      axes.front().identity.temperature_scale);
  text += shared_functions;
  for (const auto& axis : axes) text += axis_text(axis);
  text += "\n#endif\n";
  return text;
}

Result<std::vector<AxisTable>> read_c_header(std::string_view text) {
  std::vector<AxisTable> axes;
  for (const char* name : {"x", "y", "z"}) {
    const auto table = [&](std::string_view array) {
      const auto declared = text_between(text, fmt::format("{}_{}[", array, name), ";");
      return float_list(text_between(declared, "{", "}"));
    };
    if (text.find(fmt::format("float gyrocal_temperature_c_{}[", name)) == std::string_view::npos) {
      continue;
    }
    auto temperature = table("float gyrocal_temperature_c");
    auto drift = table("float gyrocal_drift_dps");
    if (!temperature || !drift || temperature->size() != drift->size()) {
      return fail(Errc::bad_input,
                  fmt::format("C header: the tables of axis {} cannot be read", name));
    }
    axes.push_back({{macro(text, "GYROCAL_BOARD"), name, macro(text, "GYROCAL_TEMPERATURE_SCALE")},
                    {std::move(*temperature), std::move(*drift)}});
  }
  if (axes.empty()) return fail(Errc::bad_input, "C header: there is no table of an axis");
  return axes;
}

}  // namespace gyrocal
