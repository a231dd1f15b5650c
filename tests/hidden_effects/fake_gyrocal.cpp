// Answers like `gyrocal diagnose --json`, from the truth file beside the sessions: what the judge
// must say about a perfect, a silent and a careless finder is known.
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

namespace {

using Json = nlohmann::json;

Json truth_of(const std::filesystem::path& session) {
  std::ifstream in(session.parent_path().parent_path() / "truth" /
                   (session.filename().string() + ".json"));
  return Json::parse(in);
}

Json finding(const Json& effect) {
  return {{"effect", effect["effect"]},
          {"amplitude", effect["amplitude"]},
          {"unit", effect["unit"]},
          {"confounded_with", Json::array()}};
}

Json answer(const std::string& mood, const Json& truth) {
  Json json = {{"format", "gyrocal-diagnosis/1"},
               {"verdict", "consistent"},
               {"findings", Json::array()},
               {"gap", {{"before", truth["effects"].empty() ? 0.0 : 2.0}, {"after", 0.0}}}};
  if (mood == "perfect") {
    json["verdict"] = truth["expected_verdict"];
    for (const auto& effect : truth["effects"]) {
      json["findings"].push_back(finding(effect));
      if (truth["expected_verdict"] == "confounded") {
        json["findings"].back()["confounded_with"] = effect["confounded_with"];
      }
    }
  } else if (mood == "careless") {
    json["verdict"] = "explained";
    json["findings"].push_back({{"effect", "aging_drift"},
                                {"amplitude", 1.0},
                                {"unit", "mdps/h"},
                                {"confounded_with", Json::array()}});
  } else {
    json["gap"]["after"] = json["gap"]["before"];
  }
  return json;
}

}  // namespace

int main(int argc, char** argv) {
  const char* mood = std::getenv("FAKE_MOOD");
  const std::string is = mood != nullptr ? mood : "perfect";
  if (is == "broken") return 1;
  if (argc != 5 || std::string(argv[1]) != "diagnose" || std::string(argv[2]) != "--session")
    return 2;
  std::puts(answer(is, truth_of(argv[3])).dump().c_str());
  return 0;
}
