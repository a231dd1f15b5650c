#include "config/rig_faults.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "config/text_file.h"
#include "config/toml_section.h"

namespace gyrocal {
namespace {

constexpr double year_s = 366 * 86400.0;

struct Kind {
  std::string_view name;
  RigFaultKind kind;
  bool on_board;
  bool lasts;
  std::optional<double> value;  // its default, if the kind has a value
  NumberRange range{0, 0};      // of the value
  bool value_must_be_given = false;
};

constexpr NumberRange share{0, 1, "share of frames"};
constexpr Kind kinds[] = {
    {"refuse", RigFaultKind::refuse, false, true, {}},
    {"late", RigFaultKind::late, false, true, 2.0, {0, 600, "s"}},
    {"lost", RigFaultKind::lost, false, true, {}},
    {"half", RigFaultKind::half, false, true, {}},
    {"doubled", RigFaultKind::doubled, false, true, {}},
    {"exception", RigFaultKind::exception, false, true, 6.0, {1, 11}},
    {"wrong_unit", RigFaultKind::wrong_unit, false, true, {}},
    {"wrong_register", RigFaultKind::wrong_register, false, true, {}},
    {"wrong_value", RigFaultKind::wrong_value, false, true, 5.0, {-200, 200, "K"}},
    {"spurious_zero", RigFaultKind::spurious_zero, false, true, {}},
    {"stuck", RigFaultKind::stuck, false, true, {}},
    {"dead", RigFaultKind::dead, false, true, {}},
    {"panel_setpoint",
     RigFaultKind::panel_setpoint,
     false,
     false,
     25.0,
     {-273, 1000, "degC"},
     true},
    {"panel_stop", RigFaultKind::panel_stop, false, false, {}},
    {"unplug", RigFaultKind::unplug, true, true, {}},
    {"mute", RigFaultKind::mute, true, true, {}},
    {"garbage", RigFaultKind::garbage, true, true, 0.05, share},
    {"duplicate", RigFaultKind::duplicate, true, true, 0.05, share},
    {"drop", RigFaultKind::drop, true, true, 0.05, share},
    {"reset", RigFaultKind::reset, true, false, {}},
    {"freeze_temperature", RigFaultKind::freeze_temperature, true, true, {}},
};

std::vector<std::string_view> kind_names() {
  std::vector<std::string_view> names;
  for (const Kind& kind : kinds) names.push_back(kind.name);
  return names;
}

void read_device(TomlSection& table, const Kind& kind, const std::vector<std::string>& boards,
                 RigFault& into) {
  std::vector<std::string_view> names;
  if (kind.on_board) {
    names.assign(boards.begin(), boards.end());
  } else {
    names.push_back("chamber");
  }
  if (!table.has("device")) {
    table.expected("device", Errc::bad_input, "\"chamber\" or the name of a board");
    return;
  }
  const std::size_t chosen = table.choice("device", 0, names);
  if (kind.on_board) into.board = chosen;
}

RigFault read_fault(TomlSection& table, const std::vector<std::string>& boards) {
  RigFault fault;
  if (!table.has("kind")) table.expected("kind", Errc::bad_input, "what goes wrong");
  const auto names = kind_names();
  const Kind& kind = kinds[table.choice("kind", 0, names)];
  fault.kind = kind.kind;
  if (!table.has("at_s")) table.expected("at_s", Errc::bad_input, "its campaign time");
  fault.at_s = table.number("at_s", 0, {0, year_s, "s"});
  if (kind.lasts) {
    if (!table.has("for_s")) table.expected("for_s", Errc::bad_input, "how long it lasts");
    fault.for_s = table.number("for_s", 1, {1e-3, year_s, "s"});
  }
  if (kind.value) {
    if (kind.value_must_be_given && !table.has("value")) {
      table.expected("value", Errc::bad_input, "the value, which has no default here");
    }
    fault.value = table.number("value", *kind.value, kind.range);
  }
  read_device(table, kind, boards, fault);
  table.refuse_unknown_keys();
  return fault;
}

}  // namespace

Result<std::vector<RigFault>> parse_rig_faults(const std::string& text, const std::string& path,
                                               const std::vector<std::string>& board_names) {
  auto file = TomlFile::parse(text, path);
  if (!file) return tl::unexpected(file.error());
  auto root = file->root();
  std::vector<RigFault> faults;
  for (TomlSection& table : root.sections("fault")) {
    faults.push_back(read_fault(table, board_names));
  }
  root.refuse_unknown_keys();
  if (const auto problems = file->problems()) return tl::unexpected(*problems);
  return faults;
}

Result<std::vector<RigFault>> read_rig_faults(const std::string& path,
                                              const std::vector<std::string>& board_names) {
  const auto text = read_text_file(path);
  if (!text) return tl::unexpected(text.error());
  return parse_rig_faults(*text, path, board_names);
}

}  // namespace gyrocal
