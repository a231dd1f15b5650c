#include "compensation/firmware/export.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <nlohmann/json.hpp>

#include "compensation/drift/analysis.h"
#include "compensation/drift/paper.h"
#include "compensation/firmware/table_text.h"

using namespace gyrocal;

namespace {

const std::vector<FittedModel>& models() {
  static const auto analysis = analyse(paper_table_1()).value();
  return analysis.models;
}

FirmwareRequest request_of(FirmwareFormat format, const FittedModel& model) {
  FirmwareRequest request;
  request.format = format;
  request.software_version = "test";
  request.axes = {{{"board A", "z", "board"}, model}};
  return request;
}

constexpr FirmwareFormat all_formats[] = {FirmwareFormat::c, FirmwareFormat::px4,
                                          FirmwareFormat::ardupilot, FirmwareFormat::csv,
                                          FirmwareFormat::json};

}  // namespace

TEST_CASE("every model goes into every format, with its loss stated", "[firmware]") {
  for (const auto& model : models()) {
    for (const auto format : all_formats) {
      CAPTURE(model.method, static_cast<int>(format));
      const auto file = export_firmware(request_of(format, model));
      REQUIRE(file.has_value());
      REQUIRE(file->losses.size() == 1);
      CHECK(file->losses[0].float_max_dps < 1e-5);
      const bool cubic = format == FirmwareFormat::px4 || format == FirmwareFormat::ardupilot;
      CHECK(file->losses[0].form_max_dps < (cubic ? 0.1 : 2e-4));
      CHECK(file->text.find("board A") != std::string::npos);
    }
  }
}

TEST_CASE("a cubic model loses nothing as PX4 or ArduPilot parameters", "[firmware]") {
  for (const auto& model : models()) {
    if (model.method != "polynomial_3") continue;
    for (const auto format : {FirmwareFormat::px4, FirmwareFormat::ardupilot}) {
      const auto file = export_firmware(request_of(format, model));
      REQUIRE(file.has_value());
      CHECK(file->losses[0].form_max_dps < 1e-9);
    }
  }
}

TEST_CASE("a model a cubic cannot follow is exported with a warning", "[firmware]") {
  const auto file = export_firmware(request_of(FirmwareFormat::ardupilot, models()[1]));
  REQUIRE(file.has_value());
  REQUIRE(file->warnings.size() == 1);
  CHECK(file->warnings[0].starts_with("axis z: a cubic cannot follow improved_gm11"));
}

TEST_CASE("the JSON export is JSON", "[firmware]") {
  auto request = request_of(FirmwareFormat::json, models()[8]);
  request.axes.push_back({{"board A", "x", "board"}, models()[0]});
  const auto file = export_firmware(request);
  REQUIRE(file.has_value());
  const auto json = nlohmann::json::parse(file->text);
  CHECK(json["format"] == "gyrocal-zero-drift/1");
  CHECK(json["board"] == "board A");
  CHECK(json["temperature_scale"] == "board");
  REQUIRE(json["axes"].size() == 2);
  CHECK(json["axes"][1]["axis"] == "x");
  CHECK(json["axes"][0]["temperature_c"].front() == -10);
  CHECK(json["axes"][0]["temperature_c"].back() == 50);
}

TEST_CASE("tables keep every setpoint", "[firmware]") {
  for (const auto& model : models()) {
    const auto table = tabulated(curve_of(model.method, model.parameters).value(), 1e-4);
    for (std::size_t i = 0; i < model.setpoint_c.size(); ++i) {
      CHECK(value_at(table, static_cast<float>(model.setpoint_c[i])) ==
            static_cast<float>(model.fitted_dps[i]));
    }
    CHECK(value_at(table, std::nanf("")) == table.drift_dps.front());
  }
}

TEST_CASE("exports that would be for the wrong sensor are refused", "[firmware][bad input]") {
  auto two = request_of(FirmwareFormat::c, models()[0]);
  two.axes.push_back({{"board B", "x", "board"}, models()[0]});
  CHECK(export_firmware(two).error().code == Errc::mismatch);
  two.axes[1].identity = {"board A", "x", "chamber"};
  CHECK(export_firmware(two).error().what ==
        "axis z is of board \"board A\" over temperature scale \"board\", axis x of \"board A\" "
        "over \"chamber\"");
  two.axes[1].identity = {"", "x", "board"};
  CHECK(export_firmware(two).error().code == Errc::mismatch);
  two.axes[1].identity = {"board A", "z", "board"};
  CHECK(export_firmware(two).error().what == "axis z is given twice");
  two.axes[1].identity = {"board A", "w", "board"};
  CHECK(export_firmware(two).error().code == Errc::bad_input);
}

TEST_CASE("what a target does not have is refused", "[firmware][bad input]") {
  auto request = request_of(FirmwareFormat::px4, models()[0]);
  request.instance = 4;
  CHECK(export_firmware(request).error().what == "PX4 has no TC_G4");
  request.format = FirmwareFormat::ardupilot;
  request.instance = 3;
  CHECK(export_firmware(request).error().what == "ArduPilot has no INS_TCAL4");
  request.axes.clear();
  CHECK(export_firmware(request).error().code == Errc::bad_input);
  CHECK(firmware_format_named("hex").error().advice == "known: c, px4, ardupilot, csv, json");
}

TEST_CASE("a board name that would break out of its quotes is refused", "[firmware][bad input]") {
  auto request = request_of(FirmwareFormat::c, models()[0]);
  request.axes[0].identity.board = "A\"\n#error";
  CHECK(export_firmware(request).error().code == Errc::bad_input);
}

TEST_CASE("asked for another board, axis or thermometer, a model is refused", "[firmware]") {
  const SensorIdentity model{"A", "z", "board"};
  CHECK(check_identity(model, {}).has_value());
  CHECK(check_identity(model, {"A", "z", "board"}).has_value());
  CHECK(check_identity(model, {"B", "", ""}).error().what ==
        "the model's board is \"A\", asked for is \"B\"");
  CHECK(check_identity(model, {"", "x", ""}).error().code == Errc::mismatch);
  CHECK(check_identity(model, {"", "", "chamber"}).error().code == Errc::mismatch);
  CHECK(check_identity({}, {"A", "", ""}).error().what ==
        "the model's board is not stated, asked for is \"A\"");
}
