#pragma once
#include <optional>
#include <string>
#include <vector>

namespace hidden {

struct StatedAmplitude {
  double value;
  std::string unit;
};

/// What was hidden, as read from truth/NNNN.json.
struct TrueEffect {
  std::string name;
  std::vector<StatedAmplitude> amplitudes;  ///< any of them is a fair answer
  bool signed_amplitude;
  std::vector<std::string> confounded_with;
};
struct Truth {
  std::string name, session, category, level;
  std::vector<std::string> accepted_verdicts;
  std::vector<TrueEffect> effects;
};

/// What the finder said, as read from its JSON (gyrocal-diagnosis/1).
struct Finding {
  std::string effect;
  double amplitude;
  std::string unit;
  std::vector<std::string> confounded_with;
};
struct Answer {
  std::string trouble;  ///< why there is no answer; empty when there is one
  std::string verdict;
  std::vector<Finding> findings;
  double gap_before = 0.0, gap_after = 0.0;
  double seconds = 0.0;
};

/// On malformed text `trouble` says what is missing.
std::optional<Truth> parse_truth(const std::string& text, std::string& trouble);
Answer parse_answer(const std::string& text);

/// One session's answer held against its truth.
struct Judged {
  Truth truth;
  Answer answer;
  std::vector<bool> found;                             ///< per true effect
  std::vector<std::optional<double>> amplitude_error;  ///< relative, per true effect, if found
  std::vector<std::string> wrong_names;  ///< named, but not there; on a null: false names
  bool admitted = false;                 ///< said unexplained and named nothing
  bool said_confounded = false;          ///< with the true effect in the set
  std::optional<double> gap_closed;      ///< 1 - after^2/before^2
};
Judged judge(const Truth& truth, const Answer& answer);

/// A rate held against what issue 6 asks for. No cases: neither passed nor failed.
struct Target {
  std::string name;
  double value;
  double wanted;
  bool at_least;  ///< else at most
  std::size_t cases;
  std::vector<std::string> culprits;  ///< sessions that count against it
  bool passed() const { return at_least ? value >= wanted : value <= wanted; }
};
std::vector<Target> targets(const std::vector<Judged>& all);

/// The targets this one session counts against by what it named or kept silent about: "wrong
/// names". Amplitudes and gaps are judged over all sessions together.
std::vector<std::string> failings(const Judged& session);

/// The value half the others exceed; 0 for none.
double median(std::vector<double> values);

}  // namespace hidden
