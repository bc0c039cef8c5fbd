// SPDX-License-Identifier: MIT
// What one more recording, which was asked for, did to names that were left.
#pragma once

#include <string>
#include <vector>

#include "tests/blind/score/score.h"

namespace blind {

/// A set of names that was left, and what became of it.
struct Second {
  enum class Outcome {
    kRight,     ///< the truth's family alone, or nothing where nothing was to be found
    kWrong,     ///< one name that is not the truth's
    kOpen,      ///< several names still
    kLost,      ///< nothing is named any more
    kNotAsked,  ///< no motion was found, or no answer came
  };
  std::string name;
  std::vector<std::string> before, after;  ///< names
  bool nameable = false;                   ///< what was left out has a name, and shows
  bool held = false;                       ///< the truth was among the names before
  double separation = 0;                   ///< squares of noise that the motion promised
  double duration = 0;                     ///< s of the recording that was asked for
  bool too_many = false;                   ///< more findings than there are truths
  Outcome outcome = Outcome::kNotAsked;
};

/// Whether a first answer leaves names.
bool leaves_names(const nlohmann::json& answer);

/// @param judged  of the first answer, which leaves names
/// @param second  the answer with one more recording; null: there is none
/// @param asked   of schema dynid.separation/1; null: there is none
Second judge_second(const Judged& judged, const nlohmann::json& second,
                    const nlohmann::json& asked);

/// Markdown.
std::string second_table(const std::vector<Second>& all);

/// A line for each set.
std::string second_lines(const std::vector<Second>& all);

}  // namespace blind
