#include "tests/hidden_effects/case_list.h"

#include "tests/hidden_effects/fast_cases.h"
#include "tests/hidden_effects/slow_cases.h"

namespace hidden {
namespace {

const std::vector<std::string> slow_names = {
    "temperature_rate", "thermal_lag",   "thermal_hysteresis", "self_heating",     "aging_drift",
    "bias_jump",        "mode_crossing", "condensation_step",  "stress_relaxation"};

using Recipe = std::function<Case(std::uint64_t)>;

class List {
 public:
  explicit List(std::uint64_t seed) : seed_(seed) {}
  void add(const std::string& what, int copies, const Recipe& recipe) {
    for (int k = 1; k <= copies; ++k) {
      const std::string name = what + "_" + std::to_string(k);
      const std::uint64_t case_seed = seed_of(name);
      cases_.push_back({name, [=] {
                          Case made = recipe(case_seed);
                          made.name = name;
                          return made;
                        }});
    }
  }
  std::vector<Listed> done() { return std::move(cases_); }

 private:
  /// From the name, so that adding a case changes no other (FNV-1a).
  std::uint64_t seed_of(const std::string& name) const {
    std::uint64_t hash = 14695981039346656037ULL ^ (seed_ * 0x9e3779b97f4a7c15ULL);
    for (char c : name) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211ULL;
    return hash;
  }
  std::uint64_t seed_;
  std::vector<Listed> cases_;
};

void add_singles(List& list, int strong, int moderate) {
  for (const auto& [level, copies] :
       {std::pair{"strong", strong}, std::pair{"moderate", moderate}}) {
    const std::string how = level;
    for (const auto& name : slow_names) {
      list.add(name + "_" + how, copies,
               [=](std::uint64_t s) { return slow_single(name, how, s, 0.45); });
    }
    for (const auto& name : fast_names()) {
      list.add(name + "_" + how, copies,
               [=](std::uint64_t s) { return fast_single(name, how, s); });
    }
  }
}

void add_pairs(List& list, int copies, bool all) {
  const std::vector<std::pair<std::string, std::string>> slow = {
      {"thermal_hysteresis", "bias_jump"},    {"temperature_rate", "aging_drift"},
      {"mode_crossing", "bias_jump"},         {"stress_relaxation", "mode_crossing"},
      {"condensation_step", "aging_drift"},   {"temperature_rate", "mode_crossing"},
      {"thermal_hysteresis", "mode_crossing"}};
  const std::vector<std::pair<std::string, std::string>> mixed = {
      {"thermal_hysteresis", "mains_hum"},
      {"bias_jump", "dropped_samples"},
      {"mode_crossing", "outlier_glitches"},
      {"temperature_rate", "stuck_samples"},
      {"stress_relaxation", "noise_temperature_dependence"}};
  const std::size_t take = all ? 100 : 1;
  for (std::size_t i = 0; i < std::min(take, slow.size()); ++i) {
    const auto [one, two] = slow[i];
    list.add("pair_" + one + "_" + two, copies,
             [=](std::uint64_t s) { return slow_pair(one, two, s); });
  }
  for (std::size_t i = 0; i < std::min(take, mixed.size()); ++i) {
    const auto [one, two] = mixed[i];
    list.add("pair_" + one + "_" + two, copies, [=](std::uint64_t s) {
      return with_fast(slow_single(one, "strong", s, 0.8), two, s);
    });
  }
}

void add_outsiders(List& list, int copies, std::size_t take) {
  const auto laws = laws_of("unknown");
  for (std::size_t i = 0; i < std::min(take, laws.size()); ++i) {
    const std::string law = laws[i];
    list.add("outside_" + law, copies, [=](std::uint64_t s) { return outsider_case(law, s); });
  }
  if (take > laws.size()) list.add("outside_tiring_noise", copies, tiring_noise_case);
}

void add_nulls(List& list, const std::vector<std::pair<std::string, int>>& plans) {
  for (const auto& [plan, copies] : plans) {
    const std::string kind = plan;
    list.add("null_" + kind, copies, [=](std::uint64_t s) { return null_case(s, kind); });
  }
}

struct Confusing {
  std::string name;
  std::vector<std::string> plans;
  bool straight;
};

void add_confounded(List& list, int copies, std::size_t take) {
  const std::vector<Confusing> all = {{"aging_drift", {"up"}, false},
                                      {"thermal_lag", {"up", "up_down"}, true},
                                      {"self_heating", {"up", "down"}, false},
                                      {"temperature_rate", {"up", "up_down"}, true},
                                      {"stress_relaxation", {"up", "down"}, false},
                                      {"condensation_step", {"up"}, false}};
  for (std::size_t i = 0; i < std::min(take, all.size()); ++i) {
    const Confusing c = all[i];
    list.add("confounded_" + c.name, copies,
             [=](std::uint64_t s) { return confounded_case(c.name, c.plans, c.straight, s); });
  }
}

}  // namespace

std::vector<Listed> list_cases(const std::string& set, std::uint64_t seed) {
  List list(seed);
  if (set == "short") {
    add_nulls(list, {{"up", 3}, {"up_down", 2}, {"shuffled", 1}, {"coarse", 1}, {"down", 1}});
    add_singles(list, 1, 0);
    add_pairs(list, 1, false);
    add_outsiders(list, 1, 4);
    add_confounded(list, 1, 3);
  } else {
    add_nulls(list, {{"up", 18},
                     {"up_down", 14},
                     {"shuffled", 8},
                     {"coarse", 6},
                     {"down", 6},
                     {"up_revisit", 6},
                     {"single", 2},
                     {"dense", 4}});
    add_singles(list, 3, 3);
    add_pairs(list, 2, true);
    add_outsiders(list, 3, 100);
    add_confounded(list, 4, 100);
  }
  return list.done();
}

}  // namespace hidden
