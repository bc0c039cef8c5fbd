// SPDX-License-Identifier: MIT
// What an answer is worth, case by case.
#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace blind {

/// One case, its truth and its answer, judged.
struct Judged {
  std::string name, kind;
  std::string habit;             ///< of recording
  nlohmann::json truth, answer;  ///< the answer without findings that are excused
  nlohmann::json excused;        ///< findings of families that the habit makes right by itself
  bool answered = false;         ///< there is a JSON of the schema
  bool found = false;            ///< something was found
  bool joint = false;            ///< the first finding is on a joint of the truth
  bool first = false;            ///< its family is the truth's
  bool among = false;            ///< the truth's family is among the aliases of a finding
  bool confident_wrong = false;  ///< a probability of 0.9 and more, and the truth is no alias
  bool both = false, one = false, third = false;  ///< of pairs
  bool undecidable = false;  ///< the truth's family stands among the undecidable
  bool flagged = false;      ///< structure without a name, and no confident name
  bool separable = false;    ///< lambda (1 - c^2) >= 30 for the other families
  double aliases = 0;        ///< names of the first finding
  double lambda = 0, absorbed = 0, excess = 0;
  double filtered = 0;  ///< of lambda below 20 Hz, away from rests
  /// Of lambda to who knows nothing of friction in the instants in which joints stop, turn and let
  /// go (blind_strength); none: not measured.
  std::optional<double> instants;
  std::optional<double> slow;       ///< of that below 40 Hz
  std::optional<double> again;      ///< lambda, measured again (blind_strength)
  std::optional<double> reach;      ///< what of it is in dynid's own equations (blind_reach)
  std::optional<double> repeating;  ///< of that what comes back in every period (blind_reach)
  double heldout = 0;               ///< rms after over the oracle's, root mean square of the joints
  double heldout_before = 0;        ///< the same of the base model
  double gap_closed = 0;            ///< of the squares between the base model and the oracle
};

Judged judge(const nlohmann::json& truth, const nlohmann::json& answer);

/// The family is the finding's first name or one of its aliases.
bool names(const nlohmann::json& finding, const std::string& family);

/// The finding is on a joint of the truth.
bool on_joint(const nlohmann::json& finding, const nlohmann::json& truth);

/// Family of the (first) truth; "nothing" where nothing was left out.
std::string family_of(const Judged& judged);

/// Family of the first finding; "without a name", "clean", "no answer".
std::string first_name(const Judged& judged);

/// Shares that a set must keep to; what a set does not hold is not judged.
struct Bounds {
  double most_false_alarms = 1;     ///< of nulls
  double most_confident_wrong = 1;  ///< of single effects and foreign physics
  double least_found = 0;           ///< of single effects of lambda 60 and more
  double least_first = 0;           ///< of these, family first
};

/// A line for each bound that is broken; empty: none.
std::string broken(const std::vector<Judged>& all, const Bounds& bounds);

/// Tables of docs/explanation/proof.md, Markdown.
std::string tables(const std::vector<Judged>& all);

/// A line for each case: what was in it, and what was said.
std::string lines(const std::vector<Judged>& all);

}  // namespace blind
