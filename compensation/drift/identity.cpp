#include "compensation/drift/identity.h"

#include <fmt/core.h>

namespace gyrocal {
namespace {

Result<void> check_part(const char* part, const std::string& model, const std::string& asked) {
  if (asked.empty() || model == asked) return {};
  return fail(Errc::mismatch,
              fmt::format("the model's {} is {}, asked for is \"{}\"", part,
                          model.empty() ? "not stated" : "\"" + model + "\"", asked),
              "take the model of this sensor: another one's drift is no compensation");
}

}  // namespace

Result<void> check_identity(const SensorIdentity& model, const SensorIdentity& asked) {
  if (auto same = check_part("board", model.board, asked.board); !same) return same;
  if (auto same = check_part("axis", model.axis, asked.axis); !same) return same;
  return check_part("temperature scale", model.temperature_scale, asked.temperature_scale);
}

}  // namespace gyrocal
