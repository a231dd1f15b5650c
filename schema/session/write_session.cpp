#include <fmt/core.h>

#include <array>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include "schema/session/session_csv.h"
#include "schema/session/session_json.h"

namespace gyrocal {
namespace {

/// CSV text as it grows: shortest numbers that read back to the same bits, nothing for `missing`.
class CsvText {
 public:
  explicit CsvText(const char* header) : text_(header) { text_ += '\n'; }

  template <class... Numbers>
  void row(Numbers... numbers) {
    (field(numbers), ...);
    text_.back() = '\n';
  }
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  void field(double value) {
    if (std::isnan(value)) {
      text_ += ',';
    } else {
      append(value);
    }
  }
  void field(std::int64_t value) { append(value); }
  void field(std::int32_t value) { append(value); }
  template <class Number>
  void append(Number value) {
    std::array<char, 32> digits{};
    const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value);
    text_.append(digits.data(), end.ptr).push_back(',');
  }
  std::string text_;
};

/// Complete or not at all: written beside, then renamed.
Result<void> write_whole(const std::string& path, const std::string& text) {
  const auto failed = [&path](int code) {
    return fail(Errc::storage, fmt::format("write {}: {}", path, std::strerror(code)));
  };
  const std::string unfinished = path + ".unfinished";
  std::FILE* file = std::fopen(unfinished.c_str(), "wbe");
  if (file == nullptr) return failed(errno);
  const bool written = std::fwrite(text.data(), 1, text.size(), file) == text.size();
  int code = written ? 0 : errno;
  if (std::fclose(file) != 0 && code == 0) code = errno;
  if (code == 0 && std::rename(unfinished.c_str(), path.c_str()) != 0) code = errno;
  if (code == 0) return {};
  std::remove(unfinished.c_str());
  return failed(code);
}

std::string monitor_text(const Session& session) {
  CsvText csv("t_s,setpoint_c,chamber_c,board_c,gyro_z_dps");
  for (const MonitorRow& row : session.monitor) {
    csv.row(row.t_s, row.setpoint_c, row.chamber_c, row.board_c, row.gyro_dps);
  }
  return csv.text();
}

std::string samples_text(const Session& session) {
  CsvText csv("dwell,seq,t_s,gyro_z_dps,acc_x_g,acc_y_g,acc_z_g,board_c,chamber_c");
  for (const SessionSample& row : session.samples) {
    csv.row(row.dwell, row.seq, row.t_s, row.gyro_dps, row.acc_g[0], row.acc_g[1], row.acc_g[2],
            row.board_c, row.chamber_c);
  }
  return csv.text();
}

}  // namespace

Result<void> write_session(const std::string& folder, const Session& session) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) return fail(Errc::storage, fmt::format("make {}: {}", folder, error.message()));
  const auto head = std::filesystem::path(folder) / "session.json";
  std::filesystem::remove(head, error);  // no head over rows of another session, should this fail
  auto done = write_whole(folder + "/monitor.csv", monitor_text(session));
  if (done) done = write_whole(folder + "/samples.csv", samples_text(session));
  if (done) done = write_whole(head.string(), to_session_json(session));
  return done;
}

}  // namespace gyrocal
