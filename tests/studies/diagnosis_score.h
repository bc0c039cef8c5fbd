// SPDX-License-Identifier: MIT
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "tests/studies/diagnosis_cases.h"

namespace dyngen::test {

/// How a simple method did on a case.
struct BaselineScore {
  std::string method;
  int names = 0;             ///< that it gave
  int wrong = 0;             ///< of families that are not in the data
  bool first_right = false;  ///< the first is of a true family
};

/// What a diagnosis said of a case, against the truth.
struct CaseScore {
  CaseKind kind = CaseKind::kNull;
  CaseNoise noise = CaseNoise::kWhite;
  unsigned seed = 0;
  std::string robot;
  double lambda = 0;
  std::string truth, answer;  ///< in words
  std::string verdict;
  std::vector<std::string> true_families;
  std::vector<std::string> answered;  ///< families of the findings; "unknown": without a name
  std::string failure;                ///< an exception's words; then nothing else counts

  bool separable = false;  ///< of the first true effect
  double likeness = 0;     ///< of its nearest other family
  std::string likest;
  double absorbed = 0;
  bool detected = false;         ///< anything was found
  bool detected_there = false;   ///< on the joint of a true effect
  bool joint_right = false;      ///< of what was found first
  bool family_right = false;     ///< of the first finding
  bool in_aliases = false;       ///< a true family is among the first finding's
  int aliases = 0;               ///< of the first finding, its own counted
  int named = 0;                 ///< true effects that some finding names
  int spurious = 0;              ///< findings that neither name nor list a true family
  bool confident = false;        ///< the first finding's probability is 0.9 or more
  bool confident_wrong = false;  ///< any finding with 0.9 or more that is spurious
  double probability = 0;        ///< of the first finding
  bool undecidable = false;      ///< the first true family is listed as such
  bool unknown = false;          ///< structure without a name was reported
  double heldout = std::numeric_limits<double>::quiet_NaN();       ///< rms over the oracle's
  double base_heldout = std::numeric_limits<double>::quiet_NaN();  ///< the base model's
  std::vector<double> errors;  ///< relative, of the parameters of effects that were named
  int intervals = 0, covered = 0;
  double seconds = 0;
  std::vector<BaselineScore> baselines;
};

/// Makes a case, diagnoses it and holds the answer against the truth. Nothing is thrown: what goes
/// wrong is `failure`.
CaseScore run_case(const CaseRequest& request, bool baselines);

/// One line of tab-separated text, and back.
std::string to_line(const CaseScore& score);
CaseScore from_line(const std::string& line);

/// What a reader wants of one case, on a line or two.
std::string in_words(const CaseScore& score);

}  // namespace dyngen::test
