#include "daemon/notify/notice.h"

#include <fmt/core.h>

#include "daemon/status/json_text.h"
#include "daemon/status/status_json.h"

namespace gyrocal::notify {

std::string notice_json(const Notice& notice, const status::View& view, const std::string& host,
                        int withheld) {
  using Json = nlohmann::ordered_json;
  const Json json{{"format", "gyrocal-notice/1"},
                  {"kind", notice.kind},
                  {"severity", notice.severity},
                  {"campaign", view.facts.campaign},
                  {"host", host},
                  {"sentence", notice.sentence},
                  {"advice", notice.advice},
                  {"withheld", withheld},
                  {"status", Json::parse(status::status_json(view), nullptr, false)}};
  return status::json_text(json) + "\n";
}

std::string subject(const Notice& notice, const std::string& campaign) {
  std::string line = fmt::format("{}: {}: {}", campaign, notice.kind, notice.sentence);
  for (char& c : line) {
    if (c == '\n' || c == '\r') c = ' ';  // a second line would be another header of a mail
  }
  return line;
}

}  // namespace gyrocal::notify
