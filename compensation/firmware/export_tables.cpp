#include <algorithm>

#include "compensation/firmware/comparison.h"
#include "compensation/firmware/table_text.h"

namespace gyrocal {
namespace {

constexpr double table_tolerance_dps = 1e-4;  // far below one count of 0.24 deg/s

}  // namespace

Result<FirmwareFile> export_tables(const FirmwareRequest& request,
                                   const std::vector<AxisCurve>& curves,
                                   const std::string& comment) {
  std::vector<AxisTable> axes;
  axes.reserve(curves.size());
  for (const auto& [identity, curve] : curves) {
    axes.push_back({identity, tabulated(curve, table_tolerance_dps)});
  }
  FirmwareFile file;
  Result<std::vector<AxisTable>> again;
  if (request.format == FirmwareFormat::c) {
    file.text = c_header_text(axes, comment);
    std::sort(axes.begin(), axes.end(), [](const auto& a, const auto& b) {
      return a.identity.axis < b.identity.axis;  // the order a header is read back in
    });
    again = read_c_header(file.text);
  } else if (request.format == FirmwareFormat::csv) {
    file.text = csv_text(axes);
    again = read_csv_text(file.text);
  } else {
    file.text = json_text(axes, comment);
    again = read_json_text(file.text);
  }
  if (!again) return tl::unexpected(std::move(again.error()));
  if (*again != axes) {
    return fail(Errc::mismatch, "the text read back holds other rows or another identity",
                "nothing was written; please report this");
  }
  for (const auto& axis : curves) {
    const auto table = std::find_if(again->begin(), again->end(), [&](const auto& t) {
      return t.identity.axis == axis.identity.axis;
    });
    auto loss = compared({axis, [&](double t) { return value_at(table->table, t); },
                          [&](float t) { return value_at(table->table, t); }});
    if (!loss) return tl::unexpected(std::move(loss.error()));
    file.losses.push_back(std::move(*loss));
  }
  return file;
}

}  // namespace gyrocal
