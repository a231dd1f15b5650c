// gyrocal denoise and gyrocal allan: what they print, and what they say to input that is none.
#include <catch2/catch.hpp>
#include <cmath>
#include <nlohmann/json.hpp>
#include <random>
#include <sstream>

#include "tests/daemon/cli/run_gyrocal.h"

using namespace gyrocal;

namespace {

std::string white_noise(int samples, double deviation) {
  std::mt19937 random(5);
  std::normal_distribution<double> normal(4.2, deviation);
  std::ostringstream text;
  text.precision(17);
  for (int i = 0; i < samples; ++i) text << normal(random) << '\n';
  return text.str();
}

struct Refusal {
  const char* arguments;
  const char* input;
  const char* says;
};

void check_refused(const Refusal& refusal) {
  CAPTURE(refusal.arguments, refusal.input);
  const Ran ran = run_gyrocal(refusal.arguments, refusal.input);
  CHECK(ran.exit_code == 2);
  CHECK(ran.out.empty());
  CHECK(ran.err.find(refusal.says) != std::string::npos);
}

}  // namespace

TEST_CASE("denoise gives back as many numbers, and with --json what it was made from",
          "[cli][denoise]") {
  const std::string signal = white_noise(3000, 1.31);
  const Ran plain = run_gyrocal("denoise", signal);
  REQUIRE(plain.exit_code == 0);
  CHECK(plain.err.empty());
  CHECK(std::count(plain.out.begin(), plain.out.end(), '\n') == 3000);

  const Ran ran = run_gyrocal("denoise --rule soft-universal --noise per-level --json", signal);
  const auto json = nlohmann::json::parse(ran.out);
  CHECK(json["coefficients"].size() == 6);
  CHECK(json["thresholds"].size() == 5);
  CHECK(json["sigma_by_level"].size() == 5);
  CHECK(json["sigma"].get<double>() == Approx(1.31).epsilon(0.05));
  CHECK(json["denoised"].size() == 3000);
}

TEST_CASE("denoise warns of a level at which the ends are everywhere", "[cli][denoise]") {
  const Ran ran = run_gyrocal("denoise --level 2", "1 2 3 4");
  CHECK(ran.exit_code == 0);
  CHECK(ran.err ==
        "warning: at level 2 every coefficient of db4 has seen an end of the 4 samples (useful up "
        "to level 0)\n");
}

TEST_CASE("denoise refuses what it cannot filter, and says what it knows",
          "[cli][denoise][bad input]") {
  for (const Refusal& refusal : {
           Refusal{"denoise", "", "standard input line 1, column 1: no number"},
           {"denoise", "1\n2 nan", "standard input line 2, column 3: 'nan'"},
           {"denoise", "1", "a signal of 1 samples cannot be decomposed"},
           {"denoise --level 3", "1 2 3 4", "choose a level from 1 to 2"},
           {"denoise --wavelet db11", "1 2", "known wavelets: haar db2"},
           {"denoise --mode symetric", "1 2", "known modes: symmetric periodization zero"},
           {"denoise --rule soft", "1 2", "known rules: approximation soft-universal"},
           {"denoise --noise per-levle", "1 2",
            "is \"per-level\" meant? estimates: global, per-level"},
           {"denoise --level x", "1 2", "--level"},
       }) {
    check_refused(refusal);
  }
}

TEST_CASE("allan tells white noise by its angle random walk", "[cli][allan]") {
  const Ran ran = run_gyrocal("allan --rate-hz 50 --json", white_noise(3000, 1.0));
  REQUIRE(ran.exit_code == 0);
  const auto json = nlohmann::json::parse(ran.out);
  const auto& walk = json["angle_random_walk"];
  CHECK(walk["value"].get<double>() == Approx(1 / std::sqrt(50.0)).epsilon(0.05));
  CHECK(walk["low"].get<double>() < 1 / std::sqrt(50.0));
  CHECK(walk["high"].get<double>() > 1 / std::sqrt(50.0));
  CHECK(json["points"][0]["deviation_dps"].get<double>() == Approx(1).epsilon(0.05));
  CHECK(json["points"][0]["low_dps"] < json["points"][0]["deviation_dps"]);
  CHECK_FALSE(json["bias_instability"]["resolved"].get<bool>());
}

TEST_CASE("allan reads a column of a table as it reads bare numbers", "[cli][allan]") {
  const std::string numbers = white_noise(200, 1.0);
  std::string table = "\xef\xbb\xbft_s,gyro_z_dps\r\n";
  std::istringstream lines(numbers);
  for (std::string line; std::getline(lines, line);) table += "0," + line + "\r\n";
  CHECK(run_gyrocal("allan --table -", table).out == run_gyrocal("allan", numbers).out);
}

TEST_CASE("allan refuses what it cannot judge", "[cli][allan][bad input]") {
  for (const Refusal& refusal : {
           Refusal{"allan", "1 2 3 4", "expected at least 32"},
           {"allan --table - --column b", "a,b\n1,2,\n", "line 2, column 3: 3 fields, expected 2"},
           {"allan --table - --column c", "a,b\n1,2\n", "no column \"c\"; the header holds: a, b"},
           {"allan --table - --column b", "a,b\n1,x\n", "line 2, column 2 (b): \"x\""},
           {"allan --rate-hz 50 --session x", "", "--rate-hz"},
       }) {
    check_refused(refusal);
  }
  const Ran missing = run_gyrocal("allan --session /nowhere");
  CHECK(missing.exit_code != 0);
  CHECK(missing.err.find("/nowhere/session.json") != std::string::npos);
  const Ran rate = run_gyrocal("allan --rate-hz -1", white_noise(64, 1));
  CHECK(rate.exit_code == 2);
  CHECK(rate.err.find("a sample rate of -1 Hz") != std::string::npos);
}
