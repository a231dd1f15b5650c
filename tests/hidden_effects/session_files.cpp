#include "tests/hidden_effects/session_files.h"

#include <array>
#include <charconv>
#include <fstream>
#include <nlohmann/json.hpp>

namespace hidden {
namespace {

class Csv {
 public:
  explicit Csv(const std::string& header) { text_ = header + "\n"; }
  Csv& number(double value, int decimals) {
    std::array<char, 40> digits{};
    const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value,
                                   std::chars_format::fixed, decimals);
    text_.append(digits.data(), end.ptr).push_back(',');
    return *this;
  }
  Csv& whole(std::int64_t value) {
    text_.append(std::to_string(value)).push_back(',');
    return *this;
  }
  Csv& empty() {
    text_.push_back(',');
    return *this;
  }
  Csv& number_if(bool known, double value, int decimals) {
    return known ? number(value, decimals) : empty();
  }
  void end_row() { text_.back() = '\n'; }
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

std::string head_text(const SessionHead& head, const Sensor& sensor, const Trajectory& over,
                      const Measured& measured) {
  nlohmann::ordered_json json = {{"format", "session-csv/1"},
                                 {"device", head.device},
                                 {"axis", head.axis},
                                 {"unit", "deg/s"},
                                 {"sample_rate_hz", sensor.rate_hz},
                                 {"monitor_interval_s", head.monitor_interval_s},
                                 {"lsb_dps", sensor.lsb_dps},
                                 {"samples_per_dwell", head.samples_per_dwell},
                                 {"dwells", nlohmann::ordered_json::array()}};
  for (std::size_t i = 0; i < measured.dwell_start_s.size(); ++i) {
    json["dwells"].push_back({{"dwell", i},
                              {"setpoint_c", over.dwells[i].setpoint_c},
                              {"t_start_s", measured.dwell_start_s[i]}});
  }
  return json.dump(1) + "\n";
}

std::string monitor_text(const Sensor& sensor, const Measured& measured) {
  Csv csv("t_s,setpoint_c,chamber_c,board_c,gyro_z_dps");
  for (const auto& row : measured.monitor) {
    csv.number(row.t_s, 3).number(row.setpoint_c, 2).number_if(sensor.has_air, row.air_c, 4);
    csv.number(row.board_c, 4).number_if(row.gyro_known, row.gyro_dps, 6).end_row();
  }
  return csv.text();
}

std::string samples_text(const Sensor& sensor, const Measured& measured) {
  Csv csv("dwell,seq,t_s,gyro_z_dps,acc_x_g,acc_y_g,acc_z_g,board_c,chamber_c");
  const bool acc = sensor.has_acceleration;
  for (const auto& row : measured.samples) {
    csv.whole(row.dwell).whole(row.seq).number(row.t_s, 4).number(row.gyro_dps, 6);
    csv.number_if(acc, row.acc_x_g, 3)
        .number_if(acc, row.acc_y_g, 3)
        .number_if(acc, row.acc_z_g, 3);
    csv.number(row.board_c, 4).number_if(sensor.has_air, row.air_c, 3).end_row();
  }
  return csv.text();
}

}  // namespace

std::string write_file(const std::filesystem::path& file, const std::string& text) {
  std::ofstream out(file, std::ios::binary);
  out << text;
  out.close();
  return out ? "" : "cannot write " + file.string();
}

std::string write_session(const std::filesystem::path& folder, const SessionHead& head,
                          const Sensor& sensor, const Trajectory& over, const Measured& measured) {
  std::error_code failed;
  std::filesystem::create_directories(folder, failed);
  if (failed) return "cannot make " + folder.string() + ": " + failed.message();
  std::string trouble =
      write_file(folder / "session.json", head_text(head, sensor, over, measured));
  if (trouble.empty()) trouble = write_file(folder / "monitor.csv", monitor_text(sensor, measured));
  if (trouble.empty()) trouble = write_file(folder / "samples.csv", samples_text(sensor, measured));
  return trouble;
}

}  // namespace hidden
